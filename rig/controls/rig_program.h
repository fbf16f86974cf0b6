#pragma once
/// RigProgram: a description resolved against one face: indices only, in the order in which evaluate() walks them.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rig/controls/control_table.h"
#include "rig/controls/rig_description.h"

namespace blush {

struct RigProgram {
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    /// A part of an array of this program.
    struct Range {
        std::uint32_t first = 0, count = 0;
        template <class T>
        std::span<const T> of(const std::vector<T>& array) const {
            return std::span<const T>(array).subspan(first, count);
        }
    };

    struct Link {
        std::uint32_t control = 0, step = 0;  ///< what is driven, and its step
        float weight = 1;
    };
    struct Corrective {
        std::uint32_t target = 0;
        Range drivers;  ///< of corrective_drivers
        CorrectiveRule rule = CorrectiveRule::product;
        float weight = 1;
    };
    /// A control that drives others, is driven, or has a limit of its own. What drives it stands before it.
    struct Step {
        std::uint32_t control = 0;
        Range links, correctives;
        float low = 0, high = 1;
        std::uint32_t with = none;  ///< control that shrinks both ends
        bool holds_own = false;
        bool wrinkles = false, bleeds = false;  ///< has zone weights, or a share of a hemoglobin map, of its own
    };

    struct InBetweenTarget {
        std::uint32_t target = 0;
        float at = 0;
    };
    struct InBetweenShape {
        std::uint32_t shape = 0;
        Range targets;  ///< of in_between_targets, ascending by `at`
    };

    struct ZoneWeight {
        std::uint32_t zone = 0;
        float weight = 0;
    };
    struct ZoneRow {
        Range drivers, weights;  ///< of zone_drivers and zone_weights
    };
    struct BloodRow {
        std::uint32_t control = 0, map = 0;
        float share = 0, factor = 1;
    };

    std::vector<Step> steps;
    std::vector<std::uint32_t> step_of;  ///< of each control, or none
    std::vector<Link> links;
    std::vector<Corrective> correctives;  ///< by the step of their target
    std::vector<std::uint32_t> corrective_drivers;
    std::vector<InBetweenShape> in_between_shapes;
    std::vector<InBetweenTarget> in_between_targets;
    std::vector<WrinkleZone> zones;
    std::vector<ZoneRow> zone_rows;
    std::vector<std::uint32_t> zone_drivers;
    std::vector<ZoneWeight> zone_weights;
    std::vector<BloodRow> blood_rows;

    std::vector<std::string> unmatched_drives;  ///< "AU13: cheekPuffLeft", one entry an expression
};

/// What the face lacks is left out.
RigProgram make_rig_program(const RigDescription& description, const ControlTable& table);

}  // namespace blush
