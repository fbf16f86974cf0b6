#include "tools/blush/plan.h"

#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "runtime/effects/effects.h"
#include "runtime/frame/character_state.h"

namespace blush::tool {
namespace {

using Json = nlohmann::ordered_json;

/// What of the rig acts, and what it leaves out: all of it exactly, since a control at 0 adds nothing.
Json describe_rig(const Rig& rig, const Pose& pose) {
    const std::span<const std::string> names = rig.control_names();
    Json json;
    json["controls"] = names.size();
    json["acting"] = Json::array();
    std::map<std::string_view, std::size_t> at_rest;
    for (std::size_t c = 0; c < names.size(); ++c) {
        const std::string_view kind = name_of(rig.info(static_cast<ControlId>(c)).kind);
        if (pose.acting[c] == 0) {
            ++at_rest[kind];
        } else {
            json["acting"].push_back({{"name", names[c]}, {"kind", kind}, {"value", pose.acting[c]}});
        }
    }
    json["at_rest"] = Json::object();
    for (const auto& [kind, count] : at_rest) json["at_rest"][std::string(kind)] = count;
    json["correctives"] = Json::array();
    for (const RigProgram::Corrective& corrective : rig.program().correctives) {
        Json entry = {{"target", names[corrective.target]}, {"value", rig.value_of(corrective, pose)}};
        for (const std::uint32_t driver : corrective.drivers.of(rig.program().corrective_drivers)) {
            if (pose.acting[driver] <= 0) entry["without"].push_back(names[driver]);
        }
        json["correctives"].push_back(std::move(entry));
    }
    json["wrinkles"] = Json::object();
    for (std::size_t z = 0; z < pose.wrinkles.size(); ++z) {
        if (pose.wrinkles[z] != 0) json["wrinkles"][rig.wrinkle_zones()[z]] = pose.wrinkles[z];
    }
    json["hemoglobin"] = Json::object();
    for (std::size_t m = 0; m < pose.hemoglobin.size(); ++m) {
        if (pose.hemoglobin[m] != 0) json["hemoglobin"][rig.hemoglobin_maps()[m]] = pose.hemoglobin[m];
    }
    json["hemoglobin_factor"] = pose.hemoglobin_factor;
    return json;
}

/// How large the face is taken to be: what scattering, translucency and the lens reckon in.
Json describe_scale(const CharacterState& state) {
    const bool set = state.settings.number(scattering_effect.name, "millimetres_a_unit") > 0;
    return {{"millimetres_a_unit", state.millimetres_a_unit},
            {"told_by", set ? "scattering.millimetres_a_unit says so" : state.facts_of_face.scale.told_by}};
}

void print_values(const char* what, const Json& values) {
    std::cout << "  " << what << ":";
    for (const auto& [name, value] : values.items()) std::cout << " " << name << " = " << value.get<float>();
    std::cout << (values.empty() ? " none" : "") << "\n";
}

void print_rig(const Json& rig) {
    std::cout << "rig: " << rig["acting"].size() << " of " << rig["controls"] << " controls act\n";
    for (const Json& control : rig["acting"]) {
        std::cout << "  " << control["name"].get<std::string>() << " = " << control["value"].get<float>() << " ("
                  << control["kind"].get<std::string>() << ")\n";
    }
    std::cout << "  left out, since at 0 (exact: changes no bit):";
    for (const auto& [kind, count] : rig["at_rest"].items()) {
        std::cout << (kind == rig["at_rest"].begin().key() ? " " : ", ") << count << " " << kind
                  << (count == 1 ? "" : "s");
    }
    std::cout << "\n";
    for (const Json& corrective : rig["correctives"]) {
        std::cout << "  corrective " << corrective["target"].get<std::string>();
        if (corrective.contains("without")) {
            std::cout << ": left out, since " << corrective["without"][0].get<std::string>() << " is at rest (exact)\n";
        } else {
            std::cout << " = " << corrective["value"].get<float>() << "\n";
        }
    }
    print_values("wrinkles", rig["wrinkles"]);
    print_values("hemoglobin", rig["hemoglobin"]);
    std::cout << "  all hemoglobin times " << rig["hemoglobin_factor"].get<float>() << "\n";
}

Json describe_frame(const Face& face, const FrameReport& report) {
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
    for (const ActiveTarget& active : report.characters[0].active) {
        json["active_targets"].push_back({{"name", face.targets[active.target].name}, {"weight", active.weight}});
    }
    json["targets"] = face.targets.size();
    json["deltas_added"] = report.deltas_added;
    json["triangles_drawn"] = report.triangles_drawn;
    return json;
}

void print_omission(const Json& effect) {
    if (effect["omission"] == "exact") {
        std::cout << " (exact: changes no bit)";
    } else {
        std::cout << " (bounded: by at most " << effect["bound"].get<double>() << " "
                  << effect["bound_unit"].get<std::string>() << ")";
    }
}

}  // namespace

Json plan_of(Portrait& character, const FrameReport& report) {
    Json json = describe_frame(character.face(), report);
    json["scale"] = describe_scale(character.state());
    json["rig"] = describe_rig(character.rig(), character.pose());
    return json;
}

std::string text_of(const Json& plan) { return plan.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

void print_plan(const Json& json) {
    const auto text = [](const Json& value) { return value.get<std::string>(); };
    std::cout << "effects\n";
    for (const Json& effect : json["effects"]) {
        std::cout << "  " << text(effect["name"]) << ": " << (effect["on"].get<bool>() ? "on" : "left out")
                  << ", since " << text(effect["reason"]);
        if (effect.contains("omission")) {
            print_omission(effect);
        }
        std::cout << "\n";
    }
    std::cout << "scale: " << json["scale"]["millimetres_a_unit"].get<float>() << " mm a unit, since "
              << text(json["scale"]["told_by"]) << "\n";
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
    print_rig(json["rig"]);
}

}  // namespace blush::tool
