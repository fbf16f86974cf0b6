/// Pinning: the border of the neck is where the host's body says, and the skin beside it follows.

#include <array>

#include "rig/deform/open_borders.h"
#include "runtime/deform/pinned_surface.h"
#include "runtime/frame/frame.h"
#include "runtime/measure/errors.h"
#include "runtime/measure/portrait.h"

namespace blush {
namespace {

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (!character.facts.pinned) {
        return {.on = false, .reason = "the host pins no vertex of it", .can_be_forced = false};
    }
    if (character.facts.pins_applied) {
        return {.on = false,
                .reason = "pins, joints and weights are those of an earlier frame, whose result still stands"};
    }
    return {.on = true, .reason = "the host pins vertices, and they or the surface moved"};
}

/// The source is what the passes so far left; from here on the pinned surface is the surface.
void declare_one(FrameState& frame, CharacterState& character) {
    prepare_pins(character);
    const auto before = character.resources;
    character.pinned->source = character.surface;
    character.surface = &character.pinned->surface;
    const auto count = static_cast<std::uint32_t>(character.face.positions.size());
    auto& after = character.resources;
    const SurfaceBuffers& pinned = *character.surface;
    after.positions = frame.graph.import_buffer("pinned positions", pinned.positions.name(), 3, count);
    after.normals = frame.graph.import_buffer("pinned normals", pinned.normals.name(), 3, count);
    after.tangents = frame.graph.import_buffer("pinned tangents", pinned.tangents.name(), 4, count);
    frame.graph.reads(before.positions)
        .reads(before.normals)
        .reads(before.tangents)
        .writes(after.positions)
        .writes(after.normals)
        .writes(after.tangents);
}

void declare(FrameState& frame) {
    const auto pin_all = [&frame](const FrameGraph&) {
        for (CharacterState* character : frame.characters) {
            if (character->on(pinning_effect)) run_pins(*character);
        }
    };
    frame.graph.pass("pin", pin_all);
    for (CharacterState* character : frame.characters) {
        if (character->on(pinning_effect)) declare_one(frame, *character);
    }
}

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

/// The neck's border, moved by 3 mm to the side.
std::vector<Study> studies(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
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

constexpr std::array<HardCase, 1> hard_cases = {{
    {"a surface without an open border", "there is nothing to pin, and it cannot be forced",
     [](Face& face) {
         // The same triangles once more, seen from the other side.
         for (Primitive& primitive : face.primitives) {
             const auto first = static_cast<std::uint32_t>(face.indices.size());
             for (std::uint32_t i = primitive.first_index; i < primitive.first_index + primitive.index_count; i += 3) {
                 const std::array<std::uint32_t, 3> front = {face.indices[i], face.indices[i + 1], face.indices[i + 2]};
                 face.indices.insert(face.indices.end(), {front[0], front[1], front[2], front[0], front[2], front[1]});
             }
             primitive.first_index = first;
             primitive.index_count *= 2;
         }
     }},
}};

}  // namespace

const Effect pinning_effect = {
    .name = "pinning",
    .what = "the host's body holds the border of the neck",
    .settings = {},
    .character_need = need,
    .declare = declare,
    .studies = studies,
    .hard_cases = hard_cases,
};

}  // namespace blush
