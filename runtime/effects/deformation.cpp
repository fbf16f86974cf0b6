/// Deformation: blend shapes by stream-out (jimenez-2012, 7.6 and 8.3).

#include <array>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/own_setting.h"

namespace blush {
namespace {

enum Method : std::uint8_t { sparse, passes };
constexpr std::array<std::string_view, 2> method_choices = {"sparse", "passes"};
constexpr std::array<Setting, 1> settings = {{
    {"method",
     "sparse: one stream-out pass over the sparse deltas of the active targets; passes: repeated stream-out passes of "
     "four dense targets each, as published",
     method_choices, sparse},
}};
using Own = OwnSetting<deformation_effect, settings>;

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (character.facts.active_targets == 0) {
        return {.on = false, .reason = "no target has a weight other than zero: the rest surface is drawn as it is"};
    }
    if (character.facts.deformation_current) {
        return {.on = false, .reason = "weights and settings are those of an earlier frame, whose result still stands"};
    }
    return {.on = true, .reason = "some target has a weight other than zero"};
}

void deform(CharacterState& character) {
    StreamOut& stream_out = character.stream_out;
    stream_out.set_active(character.active());
    if (character.settings.choice(Own("method")) == passes) {
        stream_out.add_targets_in_passes(character.normal_method);
    } else {
        stream_out.add_targets_sparse(character.normal_method);
    }
    character.report->deltas_added = stream_out.last_work().deltas;
    ++character.report->stream_outs;
}

void declare(FrameState& frame) {
    const auto deform_all = [&frame](const FrameGraph&) {
        for (CharacterState* character : frame.characters) {
            if (!character->on(deformation_effect)) continue;
            deform(*character);
            frame.report.deltas_added += character->report->deltas_added;
        }
    };
    frame.graph.pass("deform", deform_all);
    for (const CharacterState* character : frame.characters) {
        if (!character->on(deformation_effect)) continue;
        frame.graph.writes(character->resources.positions)
            .writes(character->resources.normals)
            .writes(character->resources.tangents);
    }
}

void leave(Face& /*face*/) {}

void scale(Face& face, float factor) {
    for (glm::vec3& position : face.positions) position *= factor;
    for (Target& target : face.targets) {
        for (glm::vec3& delta : target.position_deltas) delta *= factor;
    }
    for (Node& node : face.nodes) node.rest.translation *= factor;
}

constexpr std::array<HardCase, 8> hard_cases = {{
    {"weight that is not a number", "counts as zero: the rest surface", leave, std::numeric_limits<float>::quiet_NaN()},
    {"infinite weight", "counts as zero: the rest surface", leave, std::numeric_limits<float>::infinity()},
    {"weight of 1e30", "limited: every value stays finite", leave, 1e30F},
    {"weight of -1", "the opposite move", leave, -1.0F},
    {"smallest denormal weight", "a move too small to see", leave, std::numeric_limits<float>::denorm_min()},
    {"head of a micrometre", "normals keep their direction", [](Face& face) { scale(face, 1e-6F); }},
    {"head of a million units", "nothing overflows", [](Face& face) { scale(face, 1e6F); }},
    {"target that moves nothing", "costs nothing and changes nothing",
     [](Face& face) {
         face.targets.push_back({});
         face.targets.back().name = "hardNothing";
     }},
}};

}  // namespace

const Effect deformation_effect = {
    .name = "deformation",
    .what = "blend shapes move the surface",
    .settings = settings,
    .character_need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
