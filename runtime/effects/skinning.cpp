/// Skinning: joints, applied after the morph (glTF 2.0, 3.7.3.3).

#include <algorithm>
#include <array>

#include "rig/deform/deform.h"
#include "runtime/frame/character_state.h"
#include "runtime/frame/effect.h"
#include "runtime/frame/frame.h"
#include "runtime/measure/errors.h"

namespace blush {
namespace {

Need need(const CharacterState& state) {
    if (!state.facts.has_joints) {
        return {.on = false, .reason = "the face has no joints", .can_be_forced = false};
    }
    return {.on = true, .reason = "the face has joints"};
}

void declare(CharacterState& state) {
    // The source is what the passes so far left; from here on the skinned surface is the surface.
    const FrameResources before = state.resources;
    state.skin_source = state.surface;
    state.surface = &state.stream_out->skinned();
    const auto count = static_cast<std::uint32_t>(state.face.positions.size());
    FrameResources& after = state.resources;
    after.positions = state.graph.import_buffer("skinned positions", state.surface->positions.name(), 3, count);
    after.normals = state.graph.import_buffer("skinned normals", state.surface->normals.name(), 3, count);
    after.tangents = state.graph.import_buffer("skinned tangents", state.surface->tangents.name(), 4, count);
    const auto skin = [&state](const FrameGraph&) {
        state.stream_out->skin(*state.skin_source, state.skinned_from_mesh);
    };
    state.graph.pass("skin", skin)
        .reads(before.positions)
        .reads(before.normals)
        .reads(before.tangents)
        .writes(after.positions)
        .writes(after.normals)
        .writes(after.tangents);
}

/// The CPU's loop in single precision is the twin; both start from the rest surface.
std::vector<Study> studies(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
    if (face.joints.empty()) return {};
    struct Kept {
        Character character;
        Character::Surface exact;
    };
    Result<Character> character = Character::create(device, face);
    if (!character) return {};
    auto kept = std::make_shared<Kept>(Kept{*std::move(character), {}});
    CharacterState& state = kept->character.state();
    deform_only(state);
    kept->exact = {face.positions, face.normals, face.tangents};
    blush::skin(face.joints, face.joint_weights, state.skinned_from_mesh, kept->exact.positions, kept->exact.normals,
                kept->exact.tangents);

    Study study{"joints on " + std::to_string(face.positions.size()) + " vertices",
                "the same sum on the CPU in single precision",
                "mm",
                {},
                kept};
    Variant variant;
    variant.label = "skinning";
    variant.is_default = true;
    variant.work = std::to_string(state.skinned_from_mesh.size()) + " joints";
    variant.run = [&state] {
        state.stream_out->skin(state.stream_out->rest(), state.skinned_from_mesh);
        glFinish();
    };
    variant.error = [&state, kept, millimetres_a_unit] {
        std::vector<glm::vec3> positions(kept->exact.positions.size());
        glGetNamedBufferSubData(state.stream_out->skinned().positions.name(), 0,
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
    .need = need,
    .declare = declare,
    .studies = studies,
    .hard_cases = hard_cases,
};

}  // namespace blush
