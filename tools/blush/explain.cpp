/// blush explain: what the frame that `render` draws runs, what it leaves out, and why.

#include <iostream>
#include <nlohmann/json.hpp>

#include "runtime/offscreen.h"
#include "tools/blush/options.h"

namespace blush::tool {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string face;
    PoseOptions pose;
    bool json = false, check_finite = false;
};

Json describe(const Face& face, const FrameReport& report) {
    Json json;
    json["effects"] = Json::array();
    for (const EffectReport& effect : report.effects) {
        Json entry = {{"name", effect.effect}, {"on", effect.on}, {"reason", effect.reason}};
        if (!effect.on) {
            entry["omission"] = effect.omission == Omission::exact ? "exact" : "bounded";
            if (effect.omission == Omission::bounded) {
                entry["bound"] = effect.bound;
                entry["bound_unit"] = effect.bound_unit;
            }
        }
        json["effects"].push_back(std::move(entry));
    }
    json["passes"] = Json::array();
    for (const PassReport& pass : report.passes) json["passes"].push_back({{"name", pass.name}, {"runs", pass.ran}});
    json["active_targets"] = Json::array();
    for (const ActiveTarget& active : report.active) {
        json["active_targets"].push_back({{"name", face.targets[active.target].name}, {"weight", active.weight}});
    }
    json["targets"] = face.targets.size();
    json["deltas_added"] = report.deltas_added;
    json["triangles_drawn"] = report.triangles_drawn;
    return json;
}

void print(const Json& json) {
    const auto text = [](const Json& value) { return value.get<std::string>(); };
    std::cout << "effects\n";
    for (const Json& effect : json["effects"]) {
        std::cout << "  " << text(effect["name"]) << ": " << (effect["on"].get<bool>() ? "on" : "left out")
                  << ", since " << text(effect["reason"]);
        if (effect.contains("omission")) {
            std::cout << (effect["omission"] == "exact" ? " (exact: changes no bit)" : " (bounded)");
        }
        std::cout << "\n";
    }
    std::cout << "passes\n";
    for (const Json& pass : json["passes"]) {
        std::cout << "  " << text(pass["name"]) << (pass["runs"].get<bool>() ? "" : ": culled, nothing reads it")
                  << "\n";
    }
    std::cout << "active targets: " << json["active_targets"].size() << " of " << json["targets"] << ", "
              << json["deltas_added"] << " deltas added, " << json["triangles_drawn"] << " triangles drawn\n";
    for (const Json& target : json["active_targets"]) {
        std::cout << "  " << text(target["name"]) << " = " << target["weight"].get<float>() << "\n";
    }
}

int explain(const Options& options) {
    Result<std::unique_ptr<Stage>> stage = make_stage(options.face, options.pose);
    if (!stage) return fail(stage.error());
    Character& character = (*stage)->character;
    constexpr std::uint32_t side = 64;  // the plan of a frame does not depend on its size
    Result<Offscreen> offscreen = Offscreen::create((*stage)->device, side, side, Output::display_srgb);
    if (!offscreen) return fail(offscreen.error());
    View view = offscreen->view();
    view.camera = character.framing(1).camera(1);
    view.check_finite = options.check_finite;
    const FrameReport& report = draw_alone(character, view);
    if (const int found = report_not_finite(report); found != 0) return found;
    const Json json = describe(character.face(), report);
    if (options.json) {
        std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
    } else {
        print(json);
    }
    return 0;
}

}  // namespace

void add_explain(CLI::App& app, int& exit_status) {
    auto options = std::make_shared<Options>();
    CLI::App* command =
        app.add_subcommand("explain", "Say what the frame that render draws runs and leaves out, and why");
    command->add_option("FACE", options->face, "A .glb, .gltf or .obj file, or \"default\"")->required();
    options->pose.add_to(*command);
    command->add_flag("--json", options->json, "Print JSON");
    command->add_flag("--check-finite", options->check_finite, "Scan what every pass writes for NaN and infinities");
    command->callback([options, &exit_status] { exit_status = explain(*options); });
}

}  // namespace blush::tool
