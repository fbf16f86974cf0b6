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

struct FrameReport {
    std::vector<EffectReport> effects;
    std::vector<PassReport> passes;
    std::vector<ActiveTarget> active;
    std::uint64_t deltas_added = 0;     ///< target deltas that the deformation added up in this frame
    std::uint32_t triangles_drawn = 0;  ///< by all passes
    std::optional<NotFinite> not_finite;
    bool incomplete = false;  ///< a temporal mode had no last frame: the next frame of the same scene has all samples
};

}  // namespace blush
