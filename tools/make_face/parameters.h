#pragma once
/// The named measures in which people differ, and what each does to the default face.
///
/// The face is built once, in its own space: the mean of a woman and a man. A person is a smooth map of that space
/// (person_shape.h), and each parameter one displacement field of the map, so that skin, lids, teeth, hair and every
/// target follow together.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tools/make_face/geometry.h"

namespace blush::make_face {

/// Where a displacement field moves space, millimetres for one millimetre (or degree, or year) of the measure.
struct Displacement {
    enum Kind {
        bell,  ///< exp(-|(p - centre) / widths|^2); its mirror image too where the centre is off the middle
        ramp,  ///< grows evenly along `axis` from `low` to `high` and stays 1 behind it
    } kind = bell;
    Vec3 move{0};
    Vec3 centre{0}, widths{1};  ///< bell
    Vec3 axis{0};               ///< ramp: unit length
    double low = 0, high = 1;   ///< ramp: along the axis, mm
};

/// Measures of the eyes' regions, which move as a whole so that lids stay on their balls.
struct EyePlacement {
    double outward_mm = 0;  ///< of the eye's centre, for one unit of the measure
    double growth = 0;      ///< share by which the region grows
    double tilt_degrees = 0;
};

struct Parameter {
    std::string_view name;
    /// Of its value: "sd" (standard deviations from the mean of the person's sex), "years", ...
    std::string_view unit = "sd";
    double least = -3, most = 3, at_rest = 0;  ///< range, and the value of the default face
    std::string_view measure{};                ///< what is measured, between which landmarks
    /// Of the measure in adults, in millimetres (degrees for the eye's tilt); all 0 where it has no published figure.
    double women = 0, men = 0, standard_deviation = 1;
    std::string_view source{};
    std::vector<Displacement> moves{};
    EyePlacement eyes{};
};

/// All parameters. `sex` (-1 woman to 1 man), `age` and `build` act through the others and through fields of their own.
std::span<const Parameter> parameters();

std::optional<std::size_t> parameter_index(std::string_view name);

}  // namespace blush::make_face
