#include "tools/blush/pose_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "rig/names.h"

namespace blush::tool {

void PoseOptions::add_to(Command& command) {
    command.option("--set", &sets, "Controls and their values, such as jawOpen=0.6,mouthSmileLeft=1; the others are 0");
    command.option("--emotion", &emotions, "Emotions and compound states, such as joy=0.7,anger=0.2");
    command.option("--state", &states, "Physiological states, such as blush=1");
    command.option("--rig", &rig_file, "A rig description; FACE.rig.json where this is left out and there is one");
    command.flag("--defaults", defaults, "Start from the file's own weights instead of zero");
    command.option("--setting", &settings, "Setting of an effect, such as deformation.method=passes");
}

namespace {

/// "NAME=VALUE,NAME=VALUE" of one option.
class Assignments {
public:
    Assignments(const Face& face, const Rig& rig, std::span<float> controls)
        : face_(face), rig_(rig), controls_(controls) {}

    /// `wanted` says which controls the option may set, `what` names them.
    template <class Wanted>
    Status apply(const std::string& option, const std::vector<std::string>& lists, Wanted wanted,
                 const std::string& what) const {
        for (const std::string& list : lists) {
            std::size_t from = 0;
            do {
                const std::size_t comma = std::min(list.find(',', from), list.size());
                if (Status set = apply_one(option, list.substr(from, comma - from), wanted, what); !set) return set;
                from = comma + 1;
            } while (from < list.size());
        }
        return Done{};
    }

private:
    template <class Wanted>
    Status apply_one(const std::string& option, const std::string& part, Wanted wanted, const std::string& what) const {
        const std::size_t equals = part.rfind('=');
        if (equals == std::string::npos) return Error{option + " " + part + ": not NAME=VALUE"};
        const std::string name = part.substr(0, equals), number = part.substr(equals + 1);
        float value = 0;
        const auto read = std::from_chars(number.data(), number.data() + number.size(), value);
        if (read.ec != std::errc() || read.ptr != number.data() + number.size() || !std::isfinite(value)) {
            return Error{option + " " + part + ": \"" + number + "\" is not a finite number"};
        }
        const std::optional<ControlId> control = rig_.find(name);
        if (!control || !wanted(*control)) return no_such(option + " " + part, name, wanted, what);
        controls_[static_cast<std::size_t>(*control)] = value;
        return Done{};
    }

    template <class Wanted>
    Error no_such(const std::string& place, const std::string& name, Wanted wanted, const std::string& what) const {
        std::vector<std::string> names;
        for (std::size_t c = 0; c < rig_.control_names().size(); ++c) {
            if (wanted(static_cast<ControlId>(c))) names.push_back(rig_.control_names()[c]);
        }
        const std::optional<std::string> near = nearest_name(name, names);
        return Error{place + ": " + face_.path + " has no " + what + " \"" + name + "\"" +
                     (near ? " (did you mean \"" + *near + "\"?)" : "")};
    }

    const Face& face_;
    const Rig& rig_;
    std::span<float> controls_;
};

}  // namespace

Status PoseOptions::apply(const Face& face, const Rig& rig, std::span<float> controls) const {
    std::ranges::fill(controls, 0.0F);
    for (std::size_t t = 0; defaults && t < face.targets.size(); ++t) controls[t] = face.targets[t].default_weight;
    const Assignments assignments(face, rig, controls);
    const auto any = [](ControlId) { return true; };
    const auto emotion = [&rig](ControlId control) {
        return rig.is(control, ControlKind::emotion) || rig.is(control, ControlKind::compound);
    };
    const auto state = [&rig](ControlId control) { return rig.is(control, ControlKind::state); };
    if (Status set = assignments.apply("--set", sets, any, "control"); !set) return set.error();
    if (Status set = assignments.apply("--emotion", emotions, emotion, "emotion"); !set) return set.error();
    return assignments.apply("--state", states, state, "state");
}

Status PoseOptions::apply_settings(
    const std::function<Status(std::string_view name, std::string_view value)>& set) const {
    for (const std::string& setting : settings) {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos) return Error{"--setting " + setting + ": not NAME=CHOICE"};
        if (Status done = set(setting.substr(0, equals), setting.substr(equals + 1)); !done) {
            return Error{"--setting " + setting + ": " + done.error().message};
        }
    }
    return Done{};
}

}  // namespace blush::tool
