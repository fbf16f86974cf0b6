#pragma once
/// An engine's own room in plain GL: boxes, one spot light with a shadow map, a framebuffer with depth and a second
/// colour attachment.

#include <epoxy/gl.h>

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace room {

constexpr std::uint32_t width = 640, height = 480, map_side = 1024;

struct Box {
    glm::vec3 low, high, colour;
    std::uint32_t id;
};

/// Colour, what each pixel shows (an id), depth with stencil.
class Target {
public:
    Target();
    GLuint name() const { return framebuffer_; }
    void clear() const;
    std::vector<std::uint8_t> colour() const;  ///< RGBA, rows from the bottom
    std::vector<std::uint32_t> ids() const;

private:
    GLuint framebuffer_ = 0, colour_ = 0, ids_ = 0, depth_ = 0;
};

/// A depth texture that looks from the light, with near at 0 and clip z from 0.
class ShadowMap {
public:
    ShadowMap();
    GLuint texture() const { return depth_; }
    GLuint framebuffer() const { return framebuffer_; }
    void clear() const;
    void copy_from(const ShadowMap& other) const;

private:
    GLuint depth_ = 0, framebuffer_ = 0;
};

struct Lamp {
    glm::dvec3 position, towards;
    glm::vec3 radiance;  ///< of white that faces it, at `reference_distance`
    float reference_distance, outer_radians;
    glm::dmat4 clip_from_world() const;  ///< z from 0 to w
};

class Renderer {
public:
    Renderer();
    void draw_depth(const std::vector<Box>& boxes, const glm::dmat4& clip_from_world, const ShadowMap& into) const;
    void draw(const std::vector<Box>& boxes, const glm::mat4& clip_from_world, const Lamp& lamp,
              const ShadowMap& shadow, const Target& into) const;

private:
    void draw_boxes(const std::vector<Box>& boxes, GLuint program) const;
    GLuint depth_program_ = 0, program_ = 0, vertex_array_ = 0;
};

}  // namespace room
