#include "rig/controls/rig_program.h"

#include <algorithm>

#include "rig/controls/control_order.h"
#include "rig/controls/rig_graph.h"

namespace blush {
namespace {

std::uint32_t size32(const auto& array) { return static_cast<std::uint32_t>(array.size()); }

/// Resolves one description; each function fills what its name says.
class Maker {
public:
    Maker(const RigDescription& description, const ControlTable& table) : description_(description), table_(table) {}

    RigProgram make() {
        steps();
        limits();
        links();
        correctives();
        in_betweens();
        wrinkles();
        hemoglobin();
        return std::move(program_);
    }

private:
    using Range = RigProgram::Range;

    void steps() {
        program_.step_of.assign(table_.names.size(), RigProgram::none);
        for (const std::uint32_t control : order_controls(dependences_of(description_, table_)).order) {
            add_step(control);
        }
        for (const Limit& limit : description_.limits) {
            const auto control = table_.find(limit.control);
            if (control && program_.step_of[*control] == RigProgram::none) add_step(*control);
        }
    }

    void add_step(std::uint32_t control) {
        program_.step_of[control] = size32(program_.steps);
        RigProgram::Step step;
        step.control = control;
        step.low = table_.infos[control].low;
        step.high = table_.infos[control].high;
        program_.steps.push_back(step);
    }

    RigProgram::Step* step_of(std::uint32_t control) {
        const std::uint32_t step = program_.step_of[control];
        return step == RigProgram::none ? nullptr : &program_.steps[step];
    }

    void limits() {
        for (const Limit& limit : description_.limits) {
            const auto control = table_.find(limit.control);
            if (!control) continue;
            RigProgram::Step& step = *step_of(*control);
            step.low = limit.low;
            step.high = limit.high;
            step.holds_own = limit.holds_own;
            const auto with = limit.with.empty() ? std::nullopt : table_.find(limit.with);
            if (with) step.with = *with;
        }
    }

    /// For each control, what it drives: an ARKit name its shapes, an expression its drives.
    void links() {
        std::vector<std::vector<ControlShare>> driven(table_.names.size());
        for (std::uint32_t c = 0; c < table_.infos.size(); ++c) {
            if (table_.infos[c].kind == ControlKind::arkit) driven[c] = table_.parts_of(table_.names[c]);
        }
        for (std::size_t i = 0; i < description_.expressions.size(); ++i) {
            const Expression& expression = description_.expressions[i];
            const std::uint32_t driver = table_.of_expression[i];
            if (table_.infos[driver].kind == ControlKind::target) continue;
            std::string unmatched;
            for (const Drive& drive : expression.drives) {
                const std::vector<ControlShare> shares = table_.driven_by(drive.control);
                if (shares.empty()) unmatched += (unmatched.empty() ? "" : ", ") + drive.control;
                for (const ControlShare& share : shares) {
                    driven[driver].push_back({share.control, share.weight * drive.weight});
                }
            }
            if (!unmatched.empty()) program_.unmatched_drives.push_back(expression.name + ": " + unmatched);
        }
        for (RigProgram::Step& step : program_.steps) {
            step.links = {size32(program_.links), size32(driven[step.control])};
            for (const ControlShare& share : driven[step.control]) {
                program_.links.push_back({share.control, program_.step_of[share.control], share.weight});
            }
        }
    }

    void correctives() {
        std::vector<RigProgram::Corrective> resolved;
        for (const Corrective& corrective : description_.correctives) {
            const auto target = table_.find(corrective.target);
            std::vector<std::uint32_t> drivers;
            for (const std::string& name : corrective.drivers) {
                if (const auto driver = table_.find(name)) drivers.push_back(*driver);
            }
            // A driver that the face lacks never acts, and so the corrective never does.
            if (!target || drivers.size() != corrective.drivers.size()) continue;
            const Range range{size32(program_.corrective_drivers), size32(drivers)};
            program_.corrective_drivers.insert(program_.corrective_drivers.end(), drivers.begin(), drivers.end());
            resolved.push_back({*target, range, corrective.rule, corrective.weight});
        }
        std::ranges::stable_sort(resolved, {}, [&](const RigProgram::Corrective& corrective) {
            return program_.step_of[corrective.target];
        });
        program_.correctives = std::move(resolved);
        for (std::uint32_t i = 0; i < size32(program_.correctives); ++i) {
            RigProgram::Step* step = step_of(program_.correctives[i].target);
            if (!step) continue;
            if (step->correctives.count++ == 0) step->correctives.first = i;
        }
    }

    void in_betweens() {
        std::vector<std::pair<std::uint32_t, RigProgram::InBetweenTarget>> found;
        for (const InBetween& in_between : description_.in_betweens) {
            const auto shape = table_.find(in_between.shape), target = table_.find(in_between.target);
            if (shape && target) found.push_back({*shape, {*target, in_between.at}});
        }
        std::ranges::sort(found, {}, [](const auto& entry) { return std::pair(entry.first, entry.second.at); });
        for (const auto& [shape, target] : found) {
            if (program_.in_between_shapes.empty() || program_.in_between_shapes.back().shape != shape) {
                program_.in_between_shapes.push_back({shape, {size32(program_.in_between_targets), 0}});
            }
            ++program_.in_between_shapes.back().targets.count;
            program_.in_between_targets.push_back(target);
        }
    }

    void add_zone_row(std::span<const std::uint32_t> drivers, std::span<const float> weights, float scale) {
        RigProgram::ZoneRow row;
        row.drivers = {size32(program_.zone_drivers), static_cast<std::uint32_t>(drivers.size())};
        program_.zone_drivers.insert(program_.zone_drivers.end(), drivers.begin(), drivers.end());
        row.weights.first = size32(program_.zone_weights);
        for (std::uint32_t zone = 0; zone < weights.size(); ++zone) {
            if (weights[zone] != 0) program_.zone_weights.push_back({zone, scale * weights[zone]});
        }
        row.weights.count = size32(program_.zone_weights) - row.weights.first;
        program_.zone_rows.push_back(row);
    }

    void wrinkles() {
        program_.zones = description_.wrinkle_zones;
        for (const WrinkleRow& row : description_.wrinkles) {
            if (row.drivers.size() == 1) {
                for (const ControlShare& share : table_.read_from(row.drivers[0])) {
                    add_zone_row({&share.control, 1}, row.weights, share.weight);
                    if (RigProgram::Step* step = step_of(share.control)) step->wrinkles = true;
                }
                continue;
            }
            std::vector<std::uint32_t> drivers;
            for (const std::string& name : row.drivers) {
                if (const auto driver = table_.find(name)) drivers.push_back(*driver);
            }
            if (drivers.size() == row.drivers.size()) add_zone_row(drivers, row.weights, 1);
        }
    }

    void hemoglobin() {
        for (const HemoglobinRow& row : description_.hemoglobin) {
            const auto map = std::ranges::find(description_.hemoglobin_maps, row.map);
            if (map == description_.hemoglobin_maps.end()) continue;
            const auto index = static_cast<std::uint32_t>(map - description_.hemoglobin_maps.begin());
            for (const ControlShare& share : table_.read_from(row.driver)) {
                program_.blood_rows.push_back({share.control, index, share.weight * row.share, row.factor});
                if (RigProgram::Step* step = step_of(share.control)) step->bleeds = true;
            }
        }
    }

    const RigDescription& description_;
    const ControlTable& table_;
    RigProgram program_;
};

}  // namespace

RigProgram make_rig_program(const RigDescription& description, const ControlTable& table) {
    return Maker(description, table).make();
}

}  // namespace blush
