/// Skinning: joints, applied after the morph (glTF 2.0, 3.7.3.3).

#include <algorithm>
#include <array>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/frame_state.h"

namespace blush {
namespace {

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (!character.facts.has_joints) {
        return {.on = false, .reason = "the face has no joints", .can_be_forced = false};
    }
    if (character.facts.skinned) {
        return {.on = false,
                .reason = "joints, weights and settings are those of an earlier frame, whose result still stands"};
    }
    return {.on = true, .reason = "the face has joints, and they or the surface moved"};
}

/// The source is what the passes so far left; from here on the skinned surface is the surface.
void declare_one(FrameState& frame, CharacterState& character) {
    const auto before = character.resources;
    character.skin_source = character.surface;
    character.surface = &character.stream_out.skinned();
    const auto count = static_cast<std::uint32_t>(character.face.positions.size());
    auto& after = character.resources;
    const SurfaceBuffers& skinned = *character.surface;
    after.positions = frame.graph.import_buffer("skinned positions", skinned.positions.name(), 3, count);
    after.normals = frame.graph.import_buffer("skinned normals", skinned.normals.name(), 3, count);
    after.tangents = frame.graph.import_buffer("skinned tangents", skinned.tangents.name(), 4, count);
    frame.graph.reads(before.positions)
        .reads(before.normals)
        .reads(before.tangents)
        .writes(after.positions)
        .writes(after.normals)
        .writes(after.tangents);
}

void declare(FrameState& frame) {
    const auto skin_all = [&frame](const FrameGraph&) {
        for (CharacterState* character : frame.characters) {
            if (!character->on(skinning_effect)) continue;
            character->stream_out.skin(*character->skin_source, character->stance.skinned_from_mesh);
            ++character->report->stream_outs;
        }
    };
    frame.graph.pass("skin", skin_all);
    for (CharacterState* character : frame.characters) {
        if (character->on(skinning_effect)) declare_one(frame, *character);
    }
}

void finish(CharacterState& character) {
    character.skinned.valid = true;
    character.skinned.settings = character.settings;
    character.skinned.active = character.active();
    character.skinned.joints = character.stance.skinned_from_mesh;
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"joint weights of zero", "the vertex stays where the morph left it",
     [](Face& face) { std::ranges::fill(face.joint_weights, glm::vec4(0)); }},
}};

}  // namespace

const Effect skinning_effect = {
    .name = "skinning",
    .what = "joints move the morphed surface",
    .settings = {},
    .character_need = need,
    .declare = declare,
    .finish = finish,
    .hard_cases = hard_cases,
};

}  // namespace blush
