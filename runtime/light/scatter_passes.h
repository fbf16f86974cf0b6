#pragma once
/// The passes of shaders/light/scatter.frag on textures, without a frame around them. Twin: rig/light/scatter_image.h.

#include <array>
#include <cstdint>
#include <vector>

#include "rig/light/scatter_image.h"
#include "runtime/gl/object.h"
#include "runtime/gl/program.h"

namespace blush {

enum class ScatterMethod : std::uint8_t { separable, gaussians4, gaussians6, jittered, off };

struct ScatterInput {
    GLuint light = 0, albedo = 0, depth = 0;  ///< textures as FrameResources has them, one sample a pixel
    std::uint32_t width = 0, height = 0;
    ScatterProjection projection;
    double follow_mm = 0;
    /// Of several characters (shaders/light/scatter.frag, MANY); null: one, with the kernel that is passed.
    const gl::Buffer* table = nullptr;
    std::int32_t only_profile = -1;  ///< with a table
};

/// What scatters in one character's skin, for several characters in one image.
struct ScatterCharacter {
    std::uint32_t number = 0;   ///< as shading writes it
    std::uint32_t profile = 0;  ///< index of its kernel
    double follow_mm = 0;
    double scale = 1;  ///< factor on ScatterInput::projection
};

/// Fills a table for ScatterInput. kernels: of each profile, all of one length. Reuses the memory of `buffer`.
class ScatterTable {
public:
    void write(std::span<const ScatterCharacter> characters, std::span<const std::vector<KernelTap>> kernels);
    const gl::Buffer& buffer() const { return buffer_; }

private:
    gl::Buffer buffer_;
    std::size_t capacity_ = 0;
    std::vector<glm::vec4> values_;
};

/// Textures of the image's size that the passes may overwrite: rgba16f, and 8 bits of stencil for `stencil`.
struct ScatterScratch {
    GLuint first = 0, second = 0, third = 0, stencil = 0;
};

class ScatterPasses {
public:
    /// Makes the programs of a method ahead. taps: of a separable pass. many: with a table.
    void require(ScatterMethod method, std::uint32_t taps, bool many);
    /// Two passes. The second one adds its result, times the albedo, to `scene`; pixels without skin are not touched.
    /// Needs scratch.first and .stencil.
    void separable(const ScatterInput& input, const std::vector<KernelTap>& taps, const ScatterScratch& scratch,
                   GLuint scene);
    /// Two passes a Gaussian and one that adds to `scene`. Needs all of `scratch` but .stencil.
    void gaussians(const ScatterInput& input, std::span<const GaussianTerm> profile, const ScatterScratch& scratch,
                   GLuint scene);
    /// One pass.
    void jittered(const ScatterInput& input, const JitteredKernel& kernel, GLuint scene);

    /// Texture fetches of one pixel of skin, by the methods above (a filtered fetch counts once).
    static std::uint32_t fetches_a_pixel(ScatterMethod method, std::uint32_t samples, bool follow);

private:
    enum class Kind : std::uint8_t { separable9, separable17, separable25, separable33, gaussian, jittered, plain };
    const gl::Program& program(Kind kind, bool composite, bool many);
    void begin(const ScatterInput& input, const gl::Program& program, GLuint light, GLuint target);

    std::array<gl::Program, 28> programs_;
    std::vector<glm::vec4> packed_;
    gl::Framebuffer framebuffer_;
    gl::VertexArray no_attributes_;
};

}  // namespace blush
