/// Joints on the GPU against the CPU's loop in single precision; both start from the rest surface.

#include "rig/deform/deform.h"
#include "runtime/frame/frame.h"
#include "runtime/measure/errors.h"
#include "runtime/measure/portrait.h"
#include "runtime/measure/studies.h"

namespace blush {

std::vector<Study> studies::skinning(const Device& device, const Face& face, double millimetres_a_unit,
                                     bool /*quick*/) {
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

}  // namespace blush
