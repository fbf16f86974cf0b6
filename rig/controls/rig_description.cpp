#include "rig/controls/rig_description.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <unordered_set>
#include <utility>

#include "rig/controls/control_order.h"
#include "rig/controls/control_table.h"
#include "rig/controls/rig_graph.h"

namespace blush {
namespace {

/// Collects the first broken rule.
class Check {
public:
    Check(const RigDescription& description, const Face& face) : description_(description), table_(face, description) {}

    Status run() {
        expressions();
        in_betweens();
        correctives();
        limits();
        wrinkles();
        hemoglobin();
        if (broken_.empty()) cycles();
        if (!broken_.empty()) return Error{broken_};
        return Done{};
    }

private:
    void broken(const std::string& place, const std::string& reason) {
        if (broken_.empty()) broken_ = place + ": " + reason;
    }

    void number(const std::string& place, float value, float low = -largest_coefficient,
                float high = largest_coefficient) {
        if (!(value >= low && value <= high)) {
            broken(place, "it must be a number from " + shown(low) + " to " + shown(high));
        }
    }
    static std::string shown(float value) {
        std::string text = std::to_string(value);
        text.erase(text.find_last_not_of('0') + 1);
        if (text.ends_with('.')) text.pop_back();
        return text;
    }

    void known(const std::string& place, const std::string& name) {
        if (!table_.knows(name)) unknown(place, name);
    }
    void unknown(const std::string& place, const std::string& name) {
        const auto near = nearest_name(name, table_.names);
        broken(place,
               "there is no control '" + name + "'" + (near ? " (did you mean '" + *near + "'?)" : std::string()));
    }
    /// The face's own target of that name.
    void own_target(const std::string& place, const std::string& name) {
        const auto control = table_.find(name);
        if (!control) return unknown(place, name);
        if (table_.infos[*control].kind != ControlKind::target) broken(place, "'" + name + "' is not a target");
    }

    void expressions() {
        std::set<std::string> names;
        for (const Expression& expression : description_.expressions) {
            const std::string place = plural_of(expression.kind) + "." + expression.name;
            if (expression.name.empty()) broken(plural_of(expression.kind), "a name is empty");
            if (expression.kind < ControlKind::action_unit) {
                broken(place, "it must be an action unit, emotion, compound or state");
            }
            if (!names.insert(canonical_name(expression.name)).second) {
                broken(place, "there is another control of this name");
            }
            if (std::ranges::find(angle_names, expression.name) != angle_names.end()) {
                broken(place, "this is the name of an angle");
            }
            std::set<std::string> driven;
            for (const Drive& drive : expression.drives) {
                const std::string at = place + ".drives." + drive.control;
                known(at, drive.control);
                number(at, drive.weight);
                if (!driven.insert(canonical_name(drive.control)).second) broken(at, "it is there twice");
            }
        }
    }

    void in_betweens() {
        std::set<std::pair<std::uint32_t, float>> places;
        std::set<std::uint32_t> shapes, targets;
        for (std::size_t i = 0; i < description_.in_betweens.size(); ++i) {
            const InBetween& in_between = description_.in_betweens[i];
            const std::string place = "in_betweens[" + std::to_string(i) + "]";
            own_target(place + ".shape", in_between.shape);
            own_target(place + ".target", in_between.target);
            if (!(in_between.at > 0 && in_between.at < 1)) broken(place + ".at", "it must be between 0 and 1");
            if (!broken_.empty()) return;
            const std::uint32_t shape = *table_.find(in_between.shape), target = *table_.find(in_between.target);
            if (!targets.insert(target).second) broken(place + ".target", "it is an in-between already");
            if (!places.insert({shape, in_between.at}).second) {
                broken(place + ".at", "the shape has an in-between there already");
            }
            shapes.insert(shape);
        }
        for (std::size_t i = 0; i < description_.in_betweens.size(); ++i) {
            const std::string& target = description_.in_betweens[i].target;
            if (broken_.empty() && shapes.contains(*table_.find(target))) {
                broken("in_betweens[" + std::to_string(i) + "].target", "'" + target + "' has in-betweens itself");
            }
        }
    }

    void correctives() {
        for (std::size_t i = 0; i < description_.correctives.size(); ++i) {
            const Corrective& corrective = description_.correctives[i];
            const std::string place = "correctives[" + std::to_string(i) + "]";
            own_target(place + ".target", corrective.target);
            number(place + ".weight", corrective.weight);
            std::set<std::uint32_t> drivers;
            for (std::size_t d = 0; d < corrective.drivers.size(); ++d) {
                const std::string at = place + ".drivers[" + std::to_string(d) + "]";
                const auto driver = table_.find(corrective.drivers[d]);
                if (!driver) {
                    known(at, corrective.drivers[d]);
                } else if (!drivers.insert(*driver).second) {
                    broken(at, "it is there twice");
                }
            }
            if (corrective.drivers.size() < 2) broken(place + ".drivers", "a corrective needs two or more");
        }
    }

    void limits() {
        std::set<std::string> names;
        for (const Limit& limit : description_.limits) {
            const std::string place = "limits." + limit.control;
            known(place, limit.control);
            if (!names.insert(canonical_name(limit.control)).second) broken(place, "it is there twice");
            number(place + ".low", limit.low, -largest_weight, 0);
            number(place + ".high", limit.high, 0, largest_weight);
            if (!limit.with.empty()) known(place + ".with", limit.with);
        }
    }

    void wrinkles() {
        if (description_.wrinkle_zones.size() > most_zones) {
            return broken("wrinkles.zones", "there may be " + std::to_string(most_zones));
        }
        std::set<std::string> names, rows;
        for (std::size_t z = 0; z < description_.wrinkle_zones.size(); ++z) {
            const WrinkleZone& zone = description_.wrinkle_zones[z];
            const std::string place = "wrinkles.zones[" + std::to_string(z) + "]";
            if (zone.name.empty()) broken(place + ".name", "it is empty");
            if (!names.insert(zone.name).second) broken(place + ".name", "there is another zone of this name");
            number(place + ".low", zone.low, -largest_coefficient, 0);  // so that a face at rest has no wrinkle
            number(place + ".high", zone.high, 0);
        }
        for (const WrinkleRow& row : description_.wrinkles) {
            std::string joined;
            for (const std::string& driver : row.drivers) joined += (joined.empty() ? "" : "+") + driver;
            const std::string place = "wrinkles.weights." + joined;
            if (row.drivers.empty()) broken("wrinkles.weights", "a row has no drivers");
            for (const std::string& driver : row.drivers) known(place, driver);
            if (!rows.insert(joined).second) broken(place, "it is there twice");
            if (row.weights.size() != description_.wrinkle_zones.size()) {
                broken(place, "it must have one weight for each of the " +
                                  std::to_string(description_.wrinkle_zones.size()) + " zones, not " +
                                  std::to_string(row.weights.size()));
            }
            for (std::size_t z = 0; z < row.weights.size(); ++z) {
                number(place + "[" + std::to_string(z) + "]", row.weights[z]);
            }
        }
    }

    void hemoglobin() {
        if (description_.hemoglobin_maps.size() > most_maps) {
            return broken("hemoglobin.maps", "there may be " + std::to_string(most_maps));
        }
        std::set<std::string> maps;
        for (const std::string& map : description_.hemoglobin_maps) {
            if (map.empty() || map == "neutral") broken("hemoglobin.maps", "a map may not be named '" + map + "'");
            if (!maps.insert(map).second) broken("hemoglobin.maps", "'" + map + "' is there twice");
        }
        std::set<std::pair<std::string, std::string>> rows;
        for (const HemoglobinRow& row : description_.hemoglobin) {
            const std::string place = "hemoglobin.weights." + row.driver;
            known(place, row.driver);
            if (!maps.contains(row.map)) broken(place + ".maps", "there is no map '" + row.map + "'");
            if (!rows.insert({row.driver, row.map}).second) broken(place + ".maps." + row.map, "it is there twice");
            number(place + ".maps." + row.map, row.share, 0);
            number(place + ".factor", row.factor, 1 / largest_coefficient);
        }
    }

    void cycles() {
        const std::vector<std::uint32_t> cycle = order_controls(dependences_of(description_, table_)).cycle;
        if (cycle.empty()) return;
        std::string path;
        for (const std::uint32_t control : cycle) path += "'" + table_.names[control] + "' > ";
        const std::string& first = table_.names[cycle.front()];
        broken("drivers", "'" + first + "' drives itself (" + path + "'" + first + "')");
    }

    const RigDescription& description_;
    const ControlTable table_;
    std::string broken_;
};

}  // namespace

std::string_view name_of(ControlKind kind) {
    constexpr std::array<std::string_view, 7> names = {"target",  "angle",    "ARKit shape", "action unit",
                                                       "emotion", "compound", "state"};
    return names[static_cast<std::size_t>(kind)];
}

std::string plural_of(ControlKind kind) {
    constexpr std::array<std::string_view, 7> names = {"targets",  "angles",    "arkit", "action_units",
                                                       "emotions", "compounds", "states"};
    return std::string(names[static_cast<std::size_t>(kind)]);
}

Status check(const RigDescription& description, const Face& face) { return Check(description, face).run(); }

}  // namespace blush
