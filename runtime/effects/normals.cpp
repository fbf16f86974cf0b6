/// Normals after the deformation: the targets' own NORMAL deltas, or turned with the deformed surface.

#include <algorithm>
#include <array>

#include "runtime/effects/effects.h"
#include "runtime/effects/normals.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/own_setting.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> source_choices = {"authored", "recomputed"};
constexpr std::array<Setting, 1> settings = {{
    {"source",
     "authored: the targets' own NORMAL deltas where they have them, else turned with the deformed surface; "
     "recomputed: "
     "turned with the deformed surface everywhere",
     source_choices, static_cast<std::uint8_t>(NormalMethod::authored)},
}};
using Own = OwnSetting<normals_effect, settings>;

void find_facts(FrameState& frame) {
    for (CharacterState* character : frame.characters) {
        const AssetState& asset = character->facts_of_face;
        character->normal_method = normal_method_of(*character);
        const auto& needs = character->normal_method == NormalMethod::authored ? asset.target_needs_turned_normals
                                                                               : asset.target_moves_normals;
        character->facts.any_turned_normals = std::ranges::any_of(needs, [](std::uint8_t turns) { return turns != 0; });
        character->facts.active_need_turned_normals = std::ranges::any_of(
            character->active(), [&](const ActiveTarget& entry) { return needs[entry.target] != 0; });
    }
}

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (!character.facts.any_turned_normals) {
        return {.on = false,
                .reason = "the deformation adds up all normals: each target that moves the surface brings its own",
                .can_be_forced = false};
    }
    if (character.facts.active_targets == 0) {
        return {.on = false, .reason = "no target has a weight other than zero: the rest normals stand"};
    }
    if (!character.facts.active_need_turned_normals) {
        return {.on = false, .reason = "no active target moves a part whose normals have to be turned"};
    }
    if (character.facts.deformation_current) {
        return {.on = false, .reason = "weights and settings are those of an earlier frame, whose result still stands"};
    }
    return {.on = true, .reason = "active targets move parts that have no normals of their own for it"};
}

void declare(FrameState& frame) {
    const auto turn_all = [&frame](const FrameGraph&) {
        for (CharacterState* character : frame.characters) {
            if (character->on(normals_effect)) character->stream_out.turn_normals(character->normal_method);
        }
    };
    frame.graph.pass("turn normals", turn_all);
    for (const CharacterState* character : frame.characters) {
        if (!character->on(normals_effect)) continue;
        frame.graph.reads(character->resources.positions)
            .modifies(character->resources.normals)
            .modifies(character->resources.tangents);
    }
}

/// Adds a target that moves every vertex to centre + factor * (vertex - centre), without NORMAL deltas.
void add_scaling_target(Face& face, glm::vec3 factor) {
    Bounds bounds;
    for (const glm::vec3 position : face.positions) bounds.add(position);
    const glm::vec3 centre = bounds.centre();
    Target target;
    target.name = "hardScale";
    for (std::uint32_t v = 0; v < face.positions.size(); ++v) {
        target.vertices.push_back(v);
        target.position_deltas.push_back((factor - 1.0F) * (face.positions[v] - centre));
    }
    face.targets = {std::move(target)};
    for (Primitive& primitive : face.primitives) primitive.normal_source = NormalSource::recomputed;
}

constexpr std::array<HardCase, 5> hard_cases = {{
    {"surface collapsed to a point", "no fan has a direction: the rest normals",
     [](Face& face) { add_scaling_target(face, glm::vec3(0)); }},
    {"surface flattened to a plane", "every normal along the plane's",
     [](Face& face) {
         add_scaling_target(face, {1, 1, 0});
     }},
    {"surface turned inside out", "normals of the mirrored surface",
     [](Face& face) { add_scaling_target(face, glm::vec3(-1)); }},
    {"triangles without area", "they add nothing to any normal",
     [](Face& face) {
         for (std::size_t i = 0; i + 2 < face.indices.size(); i += 6) face.indices[i + 1] = face.indices[i];
         add_scaling_target(face, {1, 2, 1});
     }},
    {"vertices that no triangle uses", "they keep their rest normals",
     [](Face& face) {
         add_scaling_target(face, {2, 1, 1});
         for (Primitive& primitive : face.primitives) primitive.index_count = primitive.index_count / 6 * 3;
     }},
}};

}  // namespace

NormalMethod normal_method_of(const CharacterState& character) {
    return static_cast<NormalMethod>(character.settings.choice(Own("source")));
}

const Effect normals_effect = {
    .name = "normals",
    .what = "normals follow the deformed surface",
    .settings = settings,
    .find_facts = find_facts,
    .character_need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
