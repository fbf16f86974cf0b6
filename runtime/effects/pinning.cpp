/// Pinning: the border of the neck is where the host's body says, and the skin beside it follows.

#include <array>

#include "runtime/deform/pinned_surface.h"
#include "runtime/effects/effects.h"
#include "runtime/frame/frame.h"

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
    .hard_cases = hard_cases,
};

}  // namespace blush
