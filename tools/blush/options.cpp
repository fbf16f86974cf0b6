#include "tools/blush/options.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>

#include "rig/names.h"
#include "runtime/files/face_file.h"
#include "runtime/files/lighting_file.h"
#include "runtime/files/occlusion_file.h"
#include "runtime/files/rig_description_file.h"
#include "runtime/frame/character_state.h"

namespace blush::tool {
namespace fs = std::filesystem;

int fail(const Error& error) {
    std::cerr << "blush: " << error.message << "\n";
    return bad_input;
}

Result<Size> parse_size(const std::string& text) {
    constexpr std::uint32_t largest_side = 16'384;  // what GL 4.5 devices commonly draw to
    Size size;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    const bool crossed = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    const auto height = crossed ? std::from_chars(width.ptr + 1, end, size.height) : width;
    if (!crossed || height.ec == std::errc::invalid_argument || height.ptr != end) {
        return Error{"--size " + text + ": not WIDTHxHEIGHT in pixels, like 960x960"};
    }
    const bool overflow = height.ec == std::errc::result_out_of_range;
    if (overflow || size.width == 0 || size.height == 0 || size.width > largest_side || size.height > largest_side) {
        return Error{"--size " + text + ": a side may be 1 to " + std::to_string(largest_side) + " pixels"};
    }
    return size;
}

CLI::Validator number_from(double low, double high) {
    const auto plain = [](double value) {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%g", value);
        return std::string(text.data());
    };
    const std::string range = plain(low) + " to " + plain(high);
    const auto check = [low, high, range](std::string& text) -> std::string {
        double value = 0;
        const char* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data(), end, value);
        const bool good = read.ec == std::errc() && read.ptr == end && value >= low && value <= high;  // false for NaN
        return good ? "" : "\"" + text + "\" is not a number from " + range;
    };
    return CLI::Validator(check, "from " + range);
}

fs::path asset_folder() {
    std::error_code failed;
    const fs::path program = fs::read_symlink("/proc/self/exe", failed);
    if (failed) return {};
    for (const char* place : {"../assets", "../share/blush"}) {
        const fs::path folder = program.parent_path() / place;
        if (fs::is_directory(folder, failed)) return folder.lexically_normal();
    }
    return {};
}

fs::path face_path(const std::string& name) { return name == "default" ? asset_folder() / "face.glb" : fs::path(name); }

void PoseOptions::add_to(CLI::App& command, bool with_settings) {
    command.add_option("--set", sets,
                       "Controls and their values, such as jawOpen=0.6,mouthSmileLeft=1; the others are 0");
    command.add_option("--emotion", emotions, "Emotions and compound states, such as joy=0.7,anger=0.2");
    command.add_option("--state", states, "Physiological states, such as blush=1");
    command.add_option("--rig", rig_file, "A rig description; FACE.rig.json where this is left out and there is one");
    command.add_flag("--defaults", defaults, "Start from the file's own weights instead of zero");
    if (with_settings) {
        command.add_option("--setting", settings, "Setting of an effect, such as deformation.method=passes");
    }
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
            for (const std::string& part : CLI::detail::split(list, ',')) {
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
            }
        }
        return Done{};
    }

private:
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

Status PoseOptions::apply_settings(Character& character) const {
    for (const std::string& setting : settings) {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos) return Error{"--setting " + setting + ": not NAME=CHOICE"};
        if (Status set = character.set(setting.substr(0, equals), setting.substr(equals + 1)); !set) {
            return Error{"--setting " + setting + ": " + set.error().message};
        }
    }
    return Done{};
}

void LightOptions::add_to(CLI::App& command) {
    command.add_option("--lights", lights, "front, side, behind, orbit, or a .json file (docs/skin.md)");
    command.add_option("--environment", environment, "A radiance map, .hdr or .exr in equal longitudes and latitudes");
    command.add_option("--environment-turn", environment_turn_degrees, "Turns the environment about +Y, degrees")
        ->check(number_from(-360, 360));
    command.add_option("--environment-factor", environment_factor, "Factor on its radiance")
        ->check(number_from(0, 1e4));
}

namespace {

/// Millimetres a unit, as its settings or itself have it.
double scale_of(Character& character) {
    const double set = character.state().settings.number("scattering", "millimetres_a_unit");
    return set > 0 ? set : character.state().scale.millimetres_a_unit;
}

}  // namespace

Result<std::optional<Lighting>> LightOptions::lighting(Character& character) const {
    if (lights.empty() && environment.empty()) return std::optional<Lighting>();
    Lighting result;
    if (!lights.empty()) {
        const Bounds bounds = moving_bounds(character.face());
        Result<Lighting> read = fs::path(lights).extension() == ".json"
                                    ? read_lighting(lights, bounds, scale_of(character))
                                    : named_lighting(lights);
        if (!read) return Error{"--lights: " + read.error().message};
        result = *std::move(read);
    }
    if (!environment.empty()) {
        Result<std::shared_ptr<const Environment>> read = read_environment(environment);
        if (!read) return Error{"--environment: " + read.error().message};
        result.environment = *std::move(read);
        result.environment_turn_radians = glm::radians(environment_turn_degrees);
        result.environment_factor = environment_factor;
    }
    return std::optional<Lighting>(std::move(result));
}

Result<RigDescription> describe_rig(const Face& face, const PoseOptions& pose) {
    return find_rig_description(face, pose.rig_file);
}

Result<std::unique_ptr<Stage>> make_stage(const std::string& face_name, const PoseOptions& pose) {
    // The face first: a bad file should be named even on a machine without GL.
    Result<Face> face = load_face(face_path(face_name));
    if (!face) return face.error();
    const Result<RigDescription> description = describe_rig(*face, pose);
    if (!description) return description.error();
    Result<FaceAppearance> appearance = load_face_appearance(appearance_folder(face->path));
    if (!appearance) return appearance.error();
    Result<std::optional<OcclusionSet>> occlusion = find_occlusion(*face);
    if (!occlusion) return occlusion.error();
    Result<Device> device = Device::headless();
    if (!device) return device.error();
    Result<Character> character = Character::create(*device, *std::move(face), *description);
    if (!character) return character.error();
    auto stage = std::make_unique<Stage>(Stage{*std::move(device), *std::move(character)});
    Character& ready = stage->character;
    ready.set_appearance(*std::move(appearance));
    ready.set_occlusion(*std::move(occlusion));
    if (Status set = pose.apply(ready.face(), ready.rig(), ready.controls()); !set) return set.error();
    if (Status set = pose.apply_settings(ready); !set) return set.error();
    return stage;
}

const FrameReport& draw_alone(Character& character, View view) {
    view.cut = true;
    const FrameReport& report = character.draw(view);
    view.cut = false;
    return report.incomplete ? character.draw(view) : report;
}

int report_not_finite(const FrameReport& report) {
    return report.not_finite ? fail({"--check-finite: " + report.not_finite->sentence()}) : 0;
}

}  // namespace blush::tool
