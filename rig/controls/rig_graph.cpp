#include "rig/controls/rig_graph.h"

namespace blush {

std::vector<Dependence> dependences_of(const RigDescription& description, const ControlTable& table) {
    std::vector<Dependence> dependences;
    for (std::uint32_t c = 0; c < table.infos.size(); ++c) {
        if (table.infos[c].kind != ControlKind::arkit) continue;
        for (const ControlShare& share : table.parts_of(table.names[c])) dependences.emplace_back(c, share.control);
    }
    for (std::size_t i = 0; i < description.expressions.size(); ++i) {
        const std::uint32_t driver = table.of_expression[i];
        if (table.infos[driver].kind == ControlKind::target) continue;  // the face's own shape takes its place
        for (const Drive& drive : description.expressions[i].drives) {
            for (const ControlShare& share : table.driven_by(drive.control)) {
                dependences.emplace_back(driver, share.control);
            }
        }
    }
    for (const Corrective& corrective : description.correctives) {
        const auto target = table.find(corrective.target);
        for (const std::string& name : corrective.drivers) {
            const auto driver = table.find(name);
            if (target && driver) dependences.emplace_back(*driver, *target);
        }
    }
    for (const Limit& limit : description.limits) {
        const auto control = table.find(limit.control), with = table.find(limit.with);
        if (control && with && !limit.with.empty()) dependences.emplace_back(*with, *control);
    }
    return dependences;
}

}  // namespace blush
