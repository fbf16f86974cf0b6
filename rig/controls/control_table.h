#pragma once
/// ControlTable: all controls of a face in order, and what a name in a description means on that face.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/controls/rig_description.h"
#include "rig/face.h"
#include "rig/names.h"

namespace blush {

/// The nine angles, in the order in which they follow the targets.
extern const std::array<std::string_view, 9> angle_names;

struct ControlInfo {
    ControlKind kind = ControlKind::target;
    float low = 0, high = 1;  ///< usual range; a weight set on the control itself may go beyond (radians for an angle)
    std::string meaning;      ///< of an expression; else empty
};

/// A share of a control.
struct ControlShare {
    std::uint32_t control = 0;
    float weight = 1;
};

class ControlTable {
public:
    ControlTable() = default;
    /// Targets, angles, those of ARKit's names that the face has in another form only, then the expressions by kind.
    ControlTable(const Face& face, const RigDescription& description);

    std::vector<std::string> names;
    std::vector<ControlInfo> infos;
    std::vector<std::uint32_t> of_expression;  ///< control of each RigDescription::expressions (maybe a target's)
    std::size_t target_count = 0;

    std::optional<std::uint32_t> find(std::string_view name) const;

    /// What a drive to `name` reaches: the control of that name; or, of ARKit's shapes, both sides of a shape that the
    /// face has split, or half of one that it has without sides. Empty: the face has nothing for it.
    std::vector<ControlShare> driven_by(std::string_view name) const;
    /// The shapes that an ARKit name stands for where the face has none of that name.
    std::vector<ControlShare> parts_of(std::string_view name) const;
    /// What says how much of `name` there is: that control; the mean of the sides of a split shape; all of a shape
    /// without sides for either side.
    std::vector<ControlShare> read_from(std::string_view name) const;
    /// Whether a description may use the name: a control, or an ARKit shape (with or without a side) that this face may
    /// lack.
    bool knows(std::string_view name) const;

    /// Those of ARKit's 52 that the face has in no form, in ARKit's order.
    std::vector<std::string> unmatched_arkit() const;

private:
    void add(std::string name, ControlInfo info);
    std::vector<std::uint32_t> sides_of(std::string_view name) const;
    std::optional<std::uint32_t> without_side(std::string_view name) const;
    bool is_own(std::string_view name) const { return targets_.find(name).has_value(); }

    NameIndex targets_, all_;
};

}  // namespace blush
