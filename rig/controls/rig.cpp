#include "rig/controls/rig.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace blush {
namespace {

/// Neither NaN, infinite nor subnormal: those count as 0.
float settled(float value) { return std::isnormal(value) ? value : 0.0F; }

float held_to_one(float value) { return std::clamp(value, 0.0F, 1.0F); }

Angles angles_from(std::span<const float> yaw_pitch_roll) {
    return {.yaw_radians = yaw_pitch_roll[0], .pitch_radians = yaw_pitch_roll[1], .roll_radians = yaw_pitch_roll[2]};
}

/// What evaluate() keeps for each step while it runs.
struct Scratch {
    Scratch(std::span<float> memory, std::size_t steps)
        : driven(memory.subspan(0, steps)),
          wrinkles_told(memory.subspan(steps, steps)),
          blood_told(memory.subspan(2 * steps, steps)) {}
    static std::size_t size(std::size_t steps) { return 3 * steps; }

    std::span<float> driven;  ///< sum of what drives the control
    /// How much of that comes from controls that have zone weights (shares of hemoglobin maps) of their own, and so
    /// have told it already.
    std::span<float> wrinkles_told, blood_told;
};

/// The part of a control's value that nothing before it has told, from 0 to 1.
float untold(const RigProgram& program, const Pose& pose, std::uint32_t control, std::size_t table) {
    const std::uint32_t step = program.step_of[control];
    const std::size_t steps = program.steps.size();
    const float told = step == RigProgram::none ? 0.0F : pose.scratch[table * steps + step];
    return held_to_one(pose.acting[control] - told);
}
constexpr std::size_t wrinkles_table = 1, blood_table = 2;  // places in Scratch

/// The value of a driven control. What drives it takes it to the ends of its range and no further; what is set on it
/// stays, unless the limit holds that too.
float limited(const RigProgram::Step& step, float own, float driven, float correction, std::span<const float> acting) {
    const float share = step.with == RigProgram::none ? 1.0F : held_to_one(acting[step.with]);
    const float low = share * step.low, high = share * step.high;
    float value = std::clamp(own + driven, std::min(low, own), std::max(high, own)) + correction;
    if (step.holds_own) value = std::clamp(value, low, high);
    return value;
}

}  // namespace

Rig::Rig(const Face& face) : Rig(face, default_description(face)) {}

Rig::Rig(const Face& face, const RigDescription& description)
    : table_(face, description),
      program_(make_rig_program(description, table_)),
      map_names_(description.hemoglobin_maps),
      unmatched_arkit_(table_.unmatched_arkit()) {
    assert(check(description, face) && "Rig() takes a description that satisfies check()");
    for (const ControlInfo& info : table_.infos) kind_in_library_.push_back(info.kind);
    for (std::size_t i = 0; i < description.expressions.size(); ++i) {
        kind_in_library_[table_.of_expression[i]] = description.expressions[i].kind;
    }
    for (const WrinkleZone& zone : description.wrinkle_zones) zone_names_.push_back(zone.name);
    node_rest_.reserve(face.nodes.size());
    for (const Node& node : face.nodes) node_rest_.push_back(node.rest);
}

std::optional<ControlId> Rig::find(std::string_view name) const {
    const std::optional<std::uint32_t> index = table_.find(name);
    if (!index) return std::nullopt;
    return static_cast<ControlId>(*index);
}

bool Rig::is(ControlId control, ControlKind kind) const {
    return info(control).kind == kind || kind_in_library_[static_cast<std::size_t>(control)] == kind;
}

std::span<const RigProgram::Link> Rig::drives(ControlId control) const {
    const std::uint32_t step = program_.step_of[static_cast<std::size_t>(control)];
    if (step == RigProgram::none) return {};
    return program_.steps[step].links.of(program_.links);
}

std::vector<std::uint32_t> Rig::reach(ControlId control) const {
    std::vector<std::uint32_t> open = {static_cast<std::uint32_t>(control)}, targets;
    std::vector<std::uint8_t> seen(table_.names.size(), 0);
    const auto visit = [&](std::uint32_t next) {
        if (std::exchange(seen[next], std::uint8_t{1}) == 0) open.push_back(next);
    };
    seen[open.front()] = 1;
    while (!open.empty()) {
        const std::uint32_t at = open.back();
        open.pop_back();
        if (at < target_count()) targets.push_back(at);
        for (const RigProgram::Link& link : drives(static_cast<ControlId>(at))) visit(link.control);
        for (const RigProgram::InBetweenShape& shape : program_.in_between_shapes) {
            if (shape.shape != at) continue;
            for (const auto& step : shape.targets.of(program_.in_between_targets)) visit(step.target);
        }
    }
    std::ranges::sort(targets);
    return targets;
}

Pose Rig::rest_pose() const {
    Pose pose;
    pose.weights.assign(target_count(), 0.0F);
    pose.nodes = node_rest_;
    pose.wrinkles.assign(program_.zones.size(), 0.0F);
    pose.hemoglobin.assign(map_names_.size(), 0.0F);
    pose.acting.assign(table_.names.size(), 0.0F);
    pose.scratch.assign(Scratch::size(program_.steps.size()), 0.0F);
    return pose;
}

void Rig::evaluate(std::span<const float> controls, Pose& pose) const {
    assert(controls.size() == table_.names.size() && "Rig::evaluate() takes one value for each control");
    assert(pose.acting.size() == table_.names.size() && "Rig::evaluate() takes a pose from rest_pose()");
    assert(pose.scratch.size() == Scratch::size(program_.steps.size()) && "Rig::evaluate() takes a pose of its rig");
    copy_own(controls, pose.acting);
    drive(pose);
    write_weights(pose);
    write_angles(pose);
    write_wrinkles(pose);
    write_hemoglobin(pose);
}

void Rig::copy_own(std::span<const float> controls, std::span<float> acting) const {
    for (std::size_t i = 0; i < target_count(); ++i) {
        acting[i] = std::clamp(settled(controls[i]), -largest_weight, largest_weight);
    }
    for (std::size_t i = target_count(); i < controls.size(); ++i) {
        const float value = settled(controls[i]);
        const ControlKind kind = table_.infos[i].kind;
        acting[i] = kind == ControlKind::angle   ? value
                    : kind == ControlKind::arkit ? std::clamp(value, -largest_weight, largest_weight)
                                                 : held_to_one(value);
    }
}

float Rig::corrective_value(const RigProgram::Corrective& corrective, std::span<const float> acting) const {
    float value = 1;
    for (const std::uint32_t driver : corrective.drivers.of(program_.corrective_drivers)) {
        const float drives = held_to_one(acting[driver]);
        if (drives == 0) return 0;
        value = corrective.rule == CorrectiveRule::product ? value * drives : std::min(value, drives);
    }
    return corrective.weight * value;
}

void Rig::drive(Pose& pose) const {
    std::ranges::fill(pose.scratch, 0.0F);
    const Scratch scratch(pose.scratch, program_.steps.size());
    const std::span<float> acting = pose.acting;
    for (std::size_t s = 0; s < program_.steps.size(); ++s) {
        const RigProgram::Step& step = program_.steps[s];
        float correction = 0;
        for (const RigProgram::Corrective& corrective : step.correctives.of(program_.correctives)) {
            correction += corrective_value(corrective, acting);
        }
        const float value = limited(step, acting[step.control], scratch.driven[s], correction, acting);
        acting[step.control] = value;
        if (value == 0) continue;
        const float low = std::min(value, 0.0F), high = std::max(value, 0.0F);
        const float wrinkles_told = step.wrinkles ? value : std::clamp(scratch.wrinkles_told[s], low, high);
        const float blood_told = step.bleeds ? value : std::clamp(scratch.blood_told[s], low, high);
        for (const RigProgram::Link& link : step.links.of(program_.links)) {
            scratch.driven[link.step] += link.weight * value;
            scratch.wrinkles_told[link.step] += link.weight * wrinkles_told;
            scratch.blood_told[link.step] += link.weight * blood_told;
        }
    }
}

void Rig::write_weights(Pose& pose) const {
    std::copy_n(pose.acting.begin(), target_count(), pose.weights.begin());
    for (const RigProgram::InBetweenShape& shape : program_.in_between_shapes) {
        const float weight = pose.acting[shape.shape];
        if (!(weight > 0 && weight < 1)) continue;
        // Piecewise linear between the shapes at either side; rest stands at 0, the shape itself at 1.
        const auto targets = shape.targets.of(program_.in_between_targets);
        std::size_t next = 0;
        while (next < targets.size() && targets[next].at <= weight) ++next;
        const float from = next == 0 ? 0.0F : targets[next - 1].at;
        const float to = next == targets.size() ? 1.0F : targets[next].at;
        const float share = (weight - from) / (to - from);
        pose.weights[shape.shape] = next == targets.size() ? share : 0.0F;
        if (next > 0) pose.weights[targets[next - 1].target] += 1 - share;
        if (next < targets.size()) pose.weights[targets[next].target] += share;
    }
    for (float& weight : pose.weights) weight = std::clamp(weight, -largest_weight, largest_weight);
}

void Rig::write_angles(Pose& pose) const {
    const std::span<const float> angles = std::span<const float>(pose.acting).subspan(target_count());
    pose.head = angles_from(angles.subspan(0, 3));
    pose.left_eye = angles_from(angles.subspan(3, 3));
    pose.right_eye = angles_from(angles.subspan(6, 3));
}

void Rig::write_wrinkles(Pose& pose) const {
    std::ranges::fill(pose.wrinkles, 0.0F);
    for (const RigProgram::ZoneRow& row : program_.zone_rows) {
        float value = 1;
        for (const std::uint32_t driver : row.drivers.of(program_.zone_drivers)) {
            value = std::min(value, untold(program_, pose, driver, wrinkles_table));
        }
        if (value == 0) continue;
        for (const auto& [zone, weight] : row.weights.of(program_.zone_weights)) pose.wrinkles[zone] += weight * value;
    }
    for (std::size_t z = 0; z < pose.wrinkles.size(); ++z) {
        pose.wrinkles[z] = std::clamp(pose.wrinkles[z], program_.zones[z].low, program_.zones[z].high);
    }
}

void Rig::write_hemoglobin(Pose& pose) const {
    // jimenez-2012, 7.4.2: weights sum to one, the neutral map has what is left. Where more than one whole is asked
    // for, all give way alike.
    std::ranges::fill(pose.hemoglobin, 0.0F);
    float sum = 0, factor_less_one = 0;
    for (const RigProgram::BloodRow& row : program_.blood_rows) {
        const float share = row.share * untold(program_, pose, row.control, blood_table);
        if (share == 0) continue;
        pose.hemoglobin[row.map] += share;
        sum += share;
        factor_less_one += share * (row.factor - 1);
    }
    if (sum > 1) {
        for (float& share : pose.hemoglobin) share /= sum;
        factor_less_one /= sum;
    }
    pose.hemoglobin_factor = 1 + factor_less_one;
}

}  // namespace blush
