/// Pinning: the neck's border on a body.

#include <epoxy/gl.h>

#include "runtime/deform/pinned_surface.h"
#include "runtime/frame/frame.h"
#include "runtime/measure/errors.h"
#include "runtime/measure/portrait.h"
#include "runtime/measure/studies.h"

namespace blush {
namespace {

/// The same sum in double precision, from the ring and the surface that the GPU has.
std::vector<glm::dvec3> exact_positions(const PinnedSurface& pinned, std::span<const glm::vec3> own) {
    std::vector<glm::dvec3> exact(own.begin(), own.end());
    for (const PinnedVertex& entry : pinned.ring) {
        for (std::size_t k = 0; k < pins_a_vertex; ++k) {
            const Pin& pin = pinned.pins[entry.pin[k]];
            if (entry.weight[k] == 0 || pin.vertex == no_vertex) continue;
            exact[entry.vertex] += static_cast<double>(entry.influence) * static_cast<double>(entry.weight[k]) *
                                   (glm::dvec3(pin.position) - glm::dvec3(own[pin.vertex]));
        }
    }
    return exact;
}

}  // namespace

/// The neck's border, moved by 3 mm to the side.
std::vector<Study> studies::pinning(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
    if (!face.joints.empty()) return {};
    struct Kept {
        Portrait character;
        std::vector<glm::dvec3> exact;
    };
    Result<Portrait> character = Portrait::create(device, face);
    if (!character) return {};
    const std::vector<std::uint32_t> border = character->character().asset().neck_border();
    if (border.empty()) return {};
    constexpr double width_mm = 20, aside_mm = 3;
    auto kept = std::make_shared<Kept>(Kept{*std::move(character), {}});
    Character& pinned = kept->character.character();
    if (!pinned.pin(border, width_mm)) return {};
    std::vector<glm::vec3> positions, normals;
    for (const std::uint32_t v : border) {
        positions.push_back(pinned.face().positions[v] +
                            glm::vec3(static_cast<float>(aside_mm / millimetres_a_unit), 0, 0));
        normals.push_back(pinned.face().normals[v]);
    }
    if (!pinned.move_pins(positions, normals)) return {};
    deform_only(kept->character.frame(), kept->character.scene().state());
    CharacterState& state = kept->character.state();
    if (!state.facts.pinned) return {};
    kept->exact = exact_positions(*state.pinned, pinned.face().positions);

    Study study{
        std::to_string(border.size()) + " pins, 20 mm wide, " + std::to_string(face.positions.size()) + " vertices",
        "the same sum in double precision",
        "mm",
        {},
        kept};
    Variant variant;
    variant.label = "pinning";
    variant.is_default = true;
    variant.work = std::to_string(state.pinned->ring.size()) + " vertices moved, all copied";
    variant.run = [&state, kept] {
        run_pins(state);
        glFinish();
    };
    variant.error = [&state, kept, millimetres_a_unit] {
        std::vector<glm::vec3> read(kept->exact.size());
        glGetNamedBufferSubData(state.pinned->surface.positions.name(), 0,
                                static_cast<GLsizeiptr>(read.size() * sizeof(glm::vec3)), read.data());
        return distance_error<glm::dvec3>(read, kept->exact, millimetres_a_unit);
    };
    study.variants.push_back(std::move(variant));
    return {std::move(study)};
}

}  // namespace blush
