/// Skinning: joints, applied after the morph (glTF 2.0, 3.7.3.3).

#include <algorithm>
#include <array>

#include "rig/deform/deform.h"
#include "runtime/effects/effects.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/frame_state.h"
#include "runtime/measure/errors.h"
#include "runtime/measure/portrait.h"

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

/// The CPU's loop in single precision is the twin; both start from the rest surface.
std::vector<Study> studies(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
    if (face.joints.empty()) return {};
    struct Kept {
        Portrait character;
        Scene::Surface exact;
    };
    Result<Portrait> character = Portrait::create(device, face);
    if (!character) return {};
    auto kept = std::make_shared<Kept>(Kept{*std::move(character), {}});
    CharacterState& state = kept->character.state();
    deform_only(kept->character.frame(), kept->character.scene().state());
    kept->exact = {face.positions, face.normals, face.tangents};
    blush::skin(face.joints, face.joint_weights, state.stance.skinned_from_mesh, kept->exact.positions,
                kept->exact.normals, kept->exact.tangents);

    Study study{"joints on " + std::to_string(face.positions.size()) + " vertices",
                "the same sum on the CPU in single precision",
                "mm",
                {},
                kept};
    Variant variant;
    variant.label = "skinning";
    variant.is_default = true;
    variant.work = std::to_string(state.stance.skinned_from_mesh.size()) + " joints";
    variant.run = [&state, kept] {
        state.stream_out.skin(state.stream_out.rest(), state.stance.skinned_from_mesh);
        glFinish();
    };
    variant.error = [&state, kept, millimetres_a_unit] {
        std::vector<glm::vec3> positions(kept->exact.positions.size());
        glGetNamedBufferSubData(state.stream_out.skinned().positions.name(), 0,
                                static_cast<GLsizeiptr>(positions.size() * sizeof(glm::vec3)), positions.data());
        return distance_error<glm::vec3>(positions, kept->exact.positions, millimetres_a_unit);
    };
    study.variants.push_back(std::move(variant));
    return {std::move(study)};
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
    .studies = studies,
    .hard_cases = hard_cases,
};

}  // namespace blush
