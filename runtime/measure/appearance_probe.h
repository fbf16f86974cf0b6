#pragma once
/// AppearanceProbe: a face's appearance maps laid out flat on the GPU, and the same on the CPU.

#include <memory>
#include <string>
#include <vector>

#include "runtime/appearance/appearance_gpu.h"
#include "runtime/measure/portrait.h"
#include "runtime/measure/study.h"

namespace blush {

class AppearanceProbe {
public:
    /// Of the maps that stand beside the face's file. Nothing when there are none, or the face does not fit the device.
    static std::shared_ptr<AppearanceProbe> create(const Device& device, const Face& face);
    static std::shared_ptr<AppearanceProbe> create(const Device& device, const Face& face, FaceAppearance appearance);

    static constexpr std::uint32_t side = 256;  ///< points, both ways

    /// Every zone at `weight`: unit normals in tangent space. Complete when it returns.
    void draw_normals(float weight);
    std::vector<glm::vec3> normals(float weight);         ///< of the GPU, rows from the top
    std::vector<glm::dvec3> exact_normals(float weight);  ///< from the maps in single precision, in double
    Variant::Error normal_error(float weight);            ///< degrees

    /// One control of the rig at 1, or none: what blood makes of white.
    void draw_colors(std::string_view control);
    std::vector<glm::vec3> colors(std::string_view control);
    std::vector<glm::dvec3> exact_colors(std::string_view control);
    /// CIEDE2000 on the typical colour of the skin; with `flushed` false, of leaving blood out.
    Variant::Error color_error(std::string_view control, bool flushed = true);

    Portrait& character() { return character_; }
    CharacterState& state() { return character_.state(); }

private:
    explicit AppearanceProbe(Portrait character) : character_(std::move(character)) {}
    /// With the part that an effect has in shading; with none, white.
    void draw(std::string_view effect);
    std::vector<glm::vec3> read() const;
    Pose pose_of(std::string_view control);

    Portrait character_;
    gl::Texture target_;
    gl::Framebuffer framebuffer_;
};

}  // namespace blush
