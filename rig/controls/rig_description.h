#pragma once
/// RigDescription: how the controls of a face act, as plain data. docs/rig_description.md is its file format.
///
/// A rig is layers of sparse matrices (compound states drive emotions, emotions drive action units, action units drive
/// shapes), then limits, in-between shapes and correctives. Everything refers to controls by name, in any of the usual
/// spellings (rig/names.h); Rig resolves the names once.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rig/face.h"
#include "rig/result.h"

namespace blush {

enum class ControlKind : std::uint8_t {
    target,       ///< one of the face's own blend shapes
    angle,        ///< of the head or an eye, radians
    arkit,        ///< one of ARKit's 52 that this face has in another form (split, or without sides)
    action_unit,  ///< FACS (Ekman, Friesen, Hager 2002)
    emotion,      ///< one of the six basic emotions, or one that a description adds
    compound,     ///< a mixture of emotions and action units with a name
    state,        ///< physiological: moves hemoglobin and little else
};
std::string_view name_of(ControlKind kind);  ///< "target", "angle", "ARKit shape", "action unit", ...
std::string plural_of(ControlKind kind);     ///< as a description's file has it: "action_units", "emotions", ...

/// "weight" of what a control adds to another for each unit of its own value. Finite.
struct Drive {
    std::string control;
    float weight = 1;
};

/// A control that is not the face's own: what it drives at 1. Where the face has a target of the same name, that target
/// takes its place, and the drives do not count.
struct Expression {
    std::string name;
    ControlKind kind = ControlKind::emotion;  ///< action_unit, emotion, compound or state
    std::string meaning;                      ///< for people; may be empty
    std::vector<Drive> drives;
};

/// `target` is what the face looks like when `shape` stands at `at` (0 < at < 1): from 0 to `at` it fades in, from `at`
/// to the next one it fades out, piecewise linear.
struct InBetween {
    std::string shape, target;
    float at = 0.5F;
};

enum class CorrectiveRule : std::uint8_t { product, minimum };

/// `target` is added where all `drivers` act at once: by the product or the least of them, each held to 0..1. So it
/// vanishes when any of them does.
struct Corrective {
    std::string target;
    std::vector<std::string> drivers;  ///< two or more
    CorrectiveRule rule = CorrectiveRule::product;
    float weight = 1;
};

/// Keeps the value of a control between low and high. Without an entry, what drives a weight takes it no further than
/// 0..1 and an angle no further than +-1 radian.
struct Limit {
    std::string control;
    float low = 0, high = 1;
    std::string with;       ///< where named: both ends shrink by the value of that control, held to 0..1
    bool holds_own = true;  ///< false: only what drives the control is held, not the value set on it
};

struct WrinkleZone {
    std::string name;
    float low = 0, high = 1;  ///< the sum is clamped to this (jimenez-2012, 8.2: 0 to 1)
};

/// Weights on the zones at full strength of all `drivers` (the least of them counts, held to 0..1).
struct WrinkleRow {
    std::vector<std::string> drivers;  ///< one or more
    std::vector<float> weights;        ///< one for each zone; negative ones smooth
};

/// A control's share of a hemoglobin map, and the factor on the hemoglobin of the whole face at full share.
struct HemoglobinRow {
    std::string driver, map;
    float share = 1;   ///< 0 or more
    float factor = 1;  ///< more than 0
};

struct RigDescription {
    std::string path;  ///< where it came from, for messages; empty: the default of a face
    std::vector<Expression> expressions;
    std::vector<InBetween> in_betweens;
    std::vector<Corrective> correctives;
    std::vector<Limit> limits;
    std::vector<WrinkleZone> wrinkle_zones;
    std::vector<WrinkleRow> wrinkles;
    std::vector<std::string> hemoglobin_maps;  ///< without the neutral one
    std::vector<HemoglobinRow> hemoglobin;
};

/// The description that a face gets from its target names: the library of expressions
/// (rig/controls/expression_library.h), and the in-betweens and correctives that names tell without doubt
/// ("jawOpen_50", "jawOpen_mouthClose").
RigDescription default_description(const Face& face);

/// Largest number that a drive, zone weight, share or factor may be.
inline constexpr float largest_coefficient = 100;

/// Far beyond what any shader samples; the search for a map by name may be plain.
inline constexpr std::size_t most_zones = 64, most_maps = 256;

/// Weights are limited to this on either side: far beyond any use, and small enough that no sum overflows.
inline constexpr float largest_weight = 1000;

/// Checks every rule stated here, and that all names are known and nothing drives itself. Returns the first broken
/// rule as a sentence that opens with the place ("correctives[3].drivers[0]: ...").
Status check(const RigDescription& description, const Face& face);

}  // namespace blush
