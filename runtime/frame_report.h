#pragma once
/// What a frame did, what it left out, and why.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rig/deform/blend_shapes.h"

namespace blush {

/// What leaving an effect out does to the picture.
enum class Omission : std::uint8_t {
    exact,    ///< changes no bit
    bounded,  ///< changes it by at most a stated, measured error
};

struct EffectReport {
    std::string_view effect;
    bool on = false;
    std::string_view reason;              ///< a sentence: why it is on, or why it could be left out
    Omission omission = Omission::exact;  ///< of an effect that is off
    double bound = 0;                     ///< of a bounded omission, in `bound_unit`
    std::string_view bound_unit;
};

struct PassReport {
    std::string_view name;
    bool ran = false;         ///< false: culled, since nothing presented depends on it
    double milliseconds = 0;  ///< on the GPU's clock; 0 unless the view asked for timing
};

/// The first value that --check-finite found.
struct NotFinite {
    std::string pass, resource, place;  ///< place: "pixel (12, 40) channel 0" or "vertex 311 component 2"
    float value = 0;                    ///< NaN, an infinity, or what a format that clamps made of a value beyond it

    std::string sentence() const;
};

/// What one character took part in, and what it cost.
struct CharacterReport {
    std::vector<EffectReport> effects;  ///< those that are asked for each character
    std::vector<ActiveTarget> active;
    std::uint64_t deltas_added = 0;       ///< target deltas that the deformation added up in this frame
    std::uint32_t stream_outs = 0;        ///< deformations of its surface
    std::uint32_t draws = 0;              ///< by all passes
    std::uint32_t triangles_drawn = 0;    ///< by all passes
    std::uint32_t lights = 0;             ///< that reach it
    std::uint32_t lights_left_out = 0;    ///< that do not, or too weakly
    double lights_left_out_radiance = 0;  ///< that white would reflect of them, at most
    bool on_screen = false;               ///< it may be seen; false only where it cannot be
};

struct FrameReport {
    /// Of all effects; one that is asked for each character is on where it is for any of them.
    std::vector<EffectReport> effects;
    std::vector<PassReport> passes;
    std::vector<CharacterReport> characters;  ///< in the order in which the scene has them
    std::uint64_t deltas_added = 0;           ///< of all characters
    std::uint32_t triangles_drawn = 0;        ///< of all characters
    std::uint32_t draws = 0;
    std::uint32_t program_switches = 0;   ///< while faces were drawn
    std::uint32_t programs_compiled = 0;  ///< 0 after Scene::warm_up()
    /// A defect of the library or of the driver, such as a shader that does not compile: the frame was not drawn.
    std::optional<std::string> failure;
    std::optional<NotFinite> not_finite;
    bool incomplete = false;  ///< a temporal mode had no last frame: the next frame of the same scene has all samples
};

}  // namespace blush
