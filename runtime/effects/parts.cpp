/// Eyes, the inside of the mouth, and hair: each with a shading of its own, simpler than the skin's. Shading does it
/// (shaders/draw/eye.glsl, mouth.glsl, hair.glsl). None of them gives light to the skin's diffusion or takes any from
/// it.

#include <algorithm>
#include <array>
#include <cmath>

#include "rig/head/eye_sockets.h"
#include "runtime/effects/effects.h"
#include "runtime/frame/frame_state.h"
#include "runtime/frame/own_setting.h"
#include "runtime/gl/shared_blocks.h"

namespace blush::shared {
#include "shaders/draw/parts_uniforms.glsl"
}  // namespace blush::shared

namespace blush {
namespace {

static_assert(lid_point_count == BLUSH_LID_POINTS);

constexpr std::array<std::string_view, 2> eye_choices = {"wet", "plain"};
constexpr std::array<std::string_view, 2> hair_choices = {"strands", "plain"};
constexpr std::array<Setting, 6> settings = {{
    {"eyes", "wet: a film of tears, the iris behind the cornea, shade below the lids; plain: as any other material",
     eye_choices, 0},
    {"hair",
     "strands: the highlights of thin cylinders along the texture's v (Kajiya and Kay 1989, Marschner et al. 2003); "
     "plain: as any other material",
     hair_choices, 0},
    {.name = "lid_shade", .meaning = "how dark the eye is below its lids", .highest = 1, .default_number = 0.75},
    {.name = "iris_depth",
     .meaning = "of the iris behind the cornea; 1: as in an eye",
     .highest = 2,
     .default_number = 1},
    {.name = "mouth_shade", .meaning = "how dark the inside of the mouth is", .highest = 1, .default_number = 1},
    {.name = "tear_roughness",
     .meaning = "of the film of tears: a wider highlight for a larger one",
     .lowest = 0.05,
     .highest = 0.6,
     .default_number = 0.14},
}};
using Own = OwnSetting<parts_effect, settings>;

struct Parts {
    bool known = false;
    bool cornea_of_its_own = false;  // before an iris that lies deep already
    std::size_t mouth_node = 0;
    std::optional<glm::vec3> mouth_front;  // of the foremost tooth, mesh units
};

Parts& parts_of(CharacterState& character) {
    Parts& own = character.model->own<Parts>();
    if (own.known) return own;
    own.known = true;
    const Face& face = character.face;
    own.cornea_of_its_own = std::ranges::any_of(
        face.materials, [](const Material& material) { return material.name.find("ornea") != std::string::npos; });
    for (std::size_t n = 0; n < face.nodes.size(); ++n) {
        if (face.nodes[n].mesh < 0) continue;
        const Mesh& mesh = face.meshes[static_cast<std::size_t>(face.nodes[n].mesh)];
        for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
            const Primitive& primitive = face.primitives[mesh.first_primitive + p];
            if (primitive.material < 0) continue;
            if (character.facts_of_face.material_kind[static_cast<std::size_t>(primitive.material)] !=
                MaterialKind::mouth)
                continue;
            for (std::uint32_t v = 0; v < primitive.vertex_count; ++v) {
                const glm::vec3& place = face.positions[primitive.first_vertex + v];
                if (own.mouth_front && own.mouth_front->z >= place.z) continue;
                own.mouth_front = place;
                own.mouth_node = n;
            }
        }
    }
    return own;
}

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    const bool any = std::ranges::any_of(character.facts_of_face.material_kind, [](MaterialKind kind) {
        return kind == MaterialKind::eye || kind == MaterialKind::mouth || kind == MaterialKind::hair;
    });
    if (!any) {
        return {.on = false, .reason = "no material is named as eyes, mouth or hair", .can_be_forced = false};
    }
    return {.on = true, .reason = "the face has eyes, a mouth or hair"};
}

/// Names the test face's only material as a part.
template <int Kind>
void name_part(Face& face) {
    static constexpr std::array<const char*, 3> names = {"eye", "teeth", "hair"};
    face.materials[0].name = names[Kind];
    if (Kind == 2) face.materials[0].alpha_mode = AlphaMode::mask;
}

constexpr std::array<HardCase, 4> hard_cases = {{
    {"a face that is an eye", "wet, without lids", name_part<0>},
    {"a face that is a tooth", "darker to the back", name_part<1>},
    {"a face of cut-out hair", "strands without a texture", name_part<2>},
    {"an eye without size", "no place for an iris",
     [](Face& face) {
         face.materials[0].name = "eye";
         for (glm::vec3& position : face.positions) position = glm::vec3(0);
     }},
}};

void write(const FrameState& /*frame*/, CharacterState& character, void* to) {
    auto& out = *static_cast<shared::PartsUniforms*>(to);
    const Parts& own = parts_of(character);
    const auto number = [&character](Own setting) { return static_cast<float>(character.settings.number(setting)); };
    out.lid_shade = number("lid_shade");
    out.iris_depth = own.cornea_of_its_own ? 0 : number("iris_depth");
    out.mouth_shade = number("mouth_shade");
    out.tear_roughness = number("tear_roughness");
    if (own.mouth_front) {
        const glm::mat4& world = character.shading_from_node[own.mouth_node];
        const glm::vec3 forward(world[2]);
        const float length = glm::length(forward);
        out.mouth_front = world * glm::vec4(*own.mouth_front, 1);
        out.mouth_forward = glm::vec4(length > 0 ? forward / length : glm::vec3(0, 0, 1), 0);
    }
    const EyeSockets& sockets = character.facts_of_face.eye_sockets;
    if (sockets.eyes.size() != 2) return;
    out.eyes_known = 1;
    out.first_pole = static_cast<int>(sockets.eyes[0].pole);
    out.second_pole = static_cast<int>(sockets.eyes[1].pole);
    out.lids_known = sockets.lids.size() == 2 ? 1 : 0;
    for (std::size_t e = 0; e < 2; ++e) {
        const Eyeball& eye = sockets.eyes[e];
        const glm::mat4& world = character.shading_from_node[eye.node];
        out.eyes[e] = world * glm::vec4(eye.centre, 1);
        out.eyes[e].w = eye.radius * glm::length(glm::vec3(world[0]));
    }
    if (sockets.lids.size() != 2) return;
    out.world_from_lids = character.shading_from_node[sockets.lid_node];
    for (std::size_t e = 0; e < 2; ++e) {
        for (std::size_t k = 0; k < lid_point_count; ++k) {
            const auto set = [&](std::size_t lid, std::uint32_t vertex) {
                const std::size_t at = (2 * e + lid) * lid_point_count + k;
                out.lid_points[at / 4][static_cast<glm::length_t>(at % 4)] = static_cast<int>(vertex);
            };
            set(0, sockets.lids[e].upper[k]);
            set(1, sockets.lids[e].lower[k]);
        }
    }
}

bool gives_model(const CharacterState& character, MaterialKind kind) {
    if (kind == MaterialKind::eye) return character.settings.choice(Own("eyes")) == 0;
    return kind != MaterialKind::hair || character.settings.choice(Own("hair")) == 0;
}

void bind(FrameState& /*frame*/, CharacterState& character, std::uint32_t /*unit*/) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BLUSH_SURFACE_POSITIONS_BINDING, character.surface->positions.name());
}

constexpr std::array<UniformField, 12> fields = {{{"lid_shade", offsetof(shared::PartsUniforms, lid_shade)},
                                                  {"iris_depth", offsetof(shared::PartsUniforms, iris_depth)},
                                                  {"mouth_shade", offsetof(shared::PartsUniforms, mouth_shade)},
                                                  {"tear_roughness", offsetof(shared::PartsUniforms, tear_roughness)},
                                                  {"mouth_front", offsetof(shared::PartsUniforms, mouth_front)},
                                                  {"mouth_forward", offsetof(shared::PartsUniforms, mouth_forward)},
                                                  {"eyes[0]", offsetof(shared::PartsUniforms, eyes)},
                                                  {"world_from_lids", offsetof(shared::PartsUniforms, world_from_lids)},
                                                  {"eyes_known", offsetof(shared::PartsUniforms, eyes_known)},
                                                  {"second_pole", offsetof(shared::PartsUniforms, second_pole)},
                                                  {"lids_known", offsetof(shared::PartsUniforms, lids_known)},
                                                  {"lid_points[0]", offsetof(shared::PartsUniforms, lid_points)}}};
constexpr ShadingPart shading = {
    .materials = materials_of(MaterialKind::eye, MaterialKind::mouth, MaterialKind::hair),
    .gives_model = gives_model,
    .uniforms = {"draw/parts_uniforms.glsl", "PartsUniforms", sizeof(shared::PartsUniforms), fields, write},
    .bind = bind,
};

}  // namespace

const Effect parts_effect = {
    .name = "parts",
    .what = "eyes, mouth and hair are shaded each in their own way",
    .settings = settings,
    .stage = Stage::light,
    .character_need = need,
    .shading = &shading,
    .hard_cases = hard_cases,
};

}  // namespace blush
