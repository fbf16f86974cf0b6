/// Draws the surfaces that the deformation left, lit, in linear HDR.

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/appearance/appearance_gpu.h"
#include "runtime/draw/draw_face.h"
#include "runtime/draw/hair_core.h"
#include "runtime/effects/parts.h"
#include "runtime/effects/scattering.h"
#include "runtime/frame/frame.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/light/environment_map.h"
#include "runtime/light/occlusion_gpu.h"
#include "runtime/light/shadow_maps.h"
#include "runtime/light/skin_tables.h"

namespace blush {
namespace {

/// A primitive as it will be drawn.
struct DrawItem {
    std::uint32_t permutation = 0;
    CharacterState* character = nullptr;
    const Primitive* primitive = nullptr;
    std::size_t draw_index = 0;
    bool mirrored = false;
    std::uint32_t order = 0;  ///< in its list
};

/// What shading draws, in order; kept for its memory.
struct DrawLists {
    std::vector<DrawItem> solid, cores, blended;
    std::vector<CharacterState*> far_to_near;
};

/// What of shading a character asks for in this frame, as bits of the permutation.
std::uint32_t shade_bits(const FrameState& frame, const CharacterState& character) {
    std::uint32_t bits = 0;
    if (frame.on(scattering_effect)) bits |= shade_scatter;
    if (character.on(reflection_effect)) bits |= shade_skin_reflection;
    if (character.shadow_lights > 0) bits |= shade_shadows;
    if (character.shadow_lights > 0 && character.on(translucency_effect)) bits |= shade_translucency;
    if (character.on(wrinkles_effect)) {
        const bool differences = character.settings.choice(wrinkles_effect.name, "encoding") == 1;
        bits |= differences ? shade_wrinkles | shade_wrinkle_differences : shade_wrinkles;
    }
    if (character.on(blood_effect)) {
        bits |= colour_from_pigments(character) ? shade_blood | shade_pigment_colour : shade_blood;
    }
    if (frame.on(environment_effect)) bits |= shade_environment;
    if (character.on(occlusion_effect)) bits |= shade_ambient_occlusion;
    if (character.on(parts_effect)) bits |= parts_bits(character);
    return bits;
}

/// T(s) of the material: jimenez-2012, eq. 5.12, as it follows from the profile or as it is printed.
void write_profile(const CharacterState& character, shared::FrameBlock& block) {
    const std::span<const GaussianTerm> profile = scatter_profile(character);
    const bool derived = character.settings.choice(translucency_effect.name, "attenuation") == 0;
    for (std::size_t k = 0; k < profile.size(); ++k) {
        const double exponent = -1 / ((derived ? 2 : 1) * profile[k].variance_mm2);
        block.profile[k] = glm::vec4(glm::vec3(profile[k].weight), static_cast<float>(exponent));
    }
    // Four standard deviations of the widest: less than a thousandth of anything passes.
    block.translucency.z = static_cast<float>(4 * std::sqrt(profile.back().variance_mm2));
}

void write_frame_block(const FrameState& frame, CharacterState& character) {
    shared::FrameBlock block{};
    block.clip_from_world = frame.camera.clip_from_view * character.view_from_shading;
    block.camera_world = glm::vec4(glm::vec3(frame.eye_world - character.origin_world), 1);
    const glm::mat4 rows = glm::transpose(character.view_from_shading);
    block.depth_from_world = -rows[2];
    block.sky_radiance_linear = glm::vec4(frame.lighting->sky_radiance_linear, 0);
    block.ground_radiance_linear = glm::vec4(frame.lighting->ground_radiance_linear, 0);
    write_ambient(frame, block);
    if (character.on(occlusion_effect)) write_occlusion_weights(character, block);
    const auto number = [&character](const Effect& effect, std::string_view setting) {
        return static_cast<float>(character.settings.number(effect.name, setting));
    };
    block.skin = {static_cast<float>(character.millimetres_a_unit), number(scattering_effect, "albedo_before"),
                  number(reflection_effect, "roughness"), number(reflection_effect, "intensity")};
    block.translucency = {number(translucency_effect, "strength"), number(translucency_effect, "drawn_in_mm"), 0, 0};
    if (character.on(parts_effect)) write_parts(character, block);
    write_profile(character, block);
    const std::size_t lights = character.shader_lights.size();
    block.counts = {static_cast<int>(lights), static_cast<int>(character.index) + 1, 0, 0};
    std::ranges::copy(character.shader_lights, block.lights);
    glNamedBufferSubData(character.frame_block.name(), 0,
                         static_cast<GLsizeiptr>(offsetof(shared::FrameBlock, lights) + lights * sizeof(shared::Light)),
                         &block);
}

/// What all characters share.
void bind_shared_maps(FrameState& frame) {
    if (frame.on(reflection_effect)) {
        const SkinTables& tables = skin_tables(frame);
        glBindTextureUnit(BLUSH_BECKMANN_UNIT, tables.beckmann.name());
        glBindTextureUnit(BLUSH_SPECULAR_ALBEDO_UNIT, tables.specular_albedo.name());
    }
    if (frame.on(environment_effect)) bind_environment(frame);
    const auto& maps = frame.scene->own<ShadowMaps>();
    if (!maps.maps.empty()) {
        glBindTextureUnit(BLUSH_SHADOW_UNIT, maps.depth.name());
        glBindSampler(BLUSH_SHADOW_UNIT, maps.nearest.name());
    }
}

/// What a character's draws have in common.
void bind_character(CharacterState& character, std::uint32_t bits) {
    glBindBufferBase(GL_UNIFORM_BUFFER, BLUSH_FRAME_BINDING, character.frame_block.name());
    character.model->bind_surface(*character.surface);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BLUSH_SURFACE_POSITIONS_BINDING, character.surface->positions.name());
    if ((bits & shade_ambient_occlusion) != 0) bind_occlusion(character);
    bind_appearance(character, (bits & shade_wrinkles) != 0, (bits & shade_blood) != 0);
}

void cull(const Face& face, const Primitive& primitive, bool mirrored) {
    const std::int32_t material = primitive.material;
    if (material >= 0 && face.materials[static_cast<std::size_t>(material)].double_sided) {
        glDisable(GL_CULL_FACE);
    } else {
        glEnable(GL_CULL_FACE);
    }
    glFrontFace(mirrored ? GL_CW : GL_CCW);
}

void draw_items(FrameState& frame, const std::vector<DrawItem>& items) {
    const CharacterState* bound = nullptr;
    for (const DrawItem& item : items) {
        CharacterState& character = *item.character;
        use_program(frame, shade_program(frame.shared, item.permutation));
        if (bound != &character) bind_character(character, shade_bits(frame, character));
        bound = &character;
        character.draw_blocks.bind(item.draw_index);
        character.model->bind_maps(character.face, item.primitive->material);
        cull(character.face, *item.primitive, item.mirrored);
        draw_elements(frame, character, *item.primitive);
    }
}

/// Writes the depth of blended hair where it is dense, after all that is solid.
void draw_hair_cores(FrameState& frame, const std::vector<DrawItem>& items) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    const CharacterState* bound = nullptr;
    for (const DrawItem& item : items) {
        CharacterState& character = *item.character;
        if (bound != &character) {
            glBindBufferBase(GL_UNIFORM_BUFFER, BLUSH_FRAME_BINDING, character.frame_block.name());
            character.model->bind_surface(*character.surface);
        }
        bound = &character;
        bind_hair_core(frame, character, *item.primitive, SeenFrom::camera);
        character.draw_blocks.bind(item.draw_index);
        cull(character.face, *item.primitive, item.mirrored);
        draw_elements(frame, character, *item.primitive);
    }
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void list_draws(FrameState& frame, DrawLists& lists) {
    lists.solid.clear();
    lists.cores.clear();
    lists.blended.clear();
    lists.far_to_near.assign(frame.characters.begin(), frame.characters.end());
    std::ranges::sort(lists.far_to_near, [&frame](const CharacterState* a, const CharacterState* b) {
        const double far_a = glm::distance(a->centre_world, frame.eye_world);
        const double far_b = glm::distance(b->centre_world, frame.eye_world);
        return far_a > far_b || (far_a == far_b && a->index < b->index);
    });
    for (CharacterState* character : lists.far_to_near) {
        if (!character->report->on_screen) continue;
        const std::uint32_t bits = shade_bits(frame, *character);
        const Face& face = character->face;
        each_drawn_primitive(*character, [&](const Primitive& primitive, std::size_t draw_index, bool mirrored) {
            const std::size_t material =
                primitive.material >= 0 ? static_cast<std::size_t>(primitive.material) : face.materials.size();
            const MaterialKind kind = character->facts_of_face.material_kind[material];
            const bool blended = is_blended(face, primitive);
            std::vector<DrawItem>& list = blended ? lists.blended : lists.solid;
            const DrawItem item{permutation_of(face, primitive.material, kind, bits),
                                character,
                                &primitive,
                                draw_index,
                                mirrored,
                                static_cast<std::uint32_t>(list.size())};
            list.push_back(item);
            if (blended && is_hair_card(*character, primitive)) lists.cores.push_back(item);
        });
    }
    // Solid surfaces come in any order: each program is used once, and for it the nearest character first.
    std::ranges::sort(lists.solid, [](const DrawItem& a, const DrawItem& b) {
        return a.permutation < b.permutation || (a.permutation == b.permutation && a.order > b.order);
    });
}

/// Attaches what shading writes and clears it.
void bind_targets(FrameState& frame, const FrameGraph& graph) {
    const ViewFrame& view = *frame.view;
    const GLuint framebuffer = frame.common->scene.name();
    const std::size_t count = frame.on(scattering_effect) ? 4 : 1;
    const FrameResources& resources = frame.resources;
    const std::array<ResourceId, 4> targets = {resources.scene_color_multisampled, resources.to_resolve[1].from,
                                               resources.to_resolve[2].from, resources.to_resolve[3].from};
    std::array<GLenum, 4> buffers{};
    const std::array<float, 4> nothing{};
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const auto attachment = static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + i);
        glNamedFramebufferTexture(framebuffer, attachment, i < count ? graph[targets[i]].handle : 0, 0);
        buffers[i] = attachment;
    }
    glNamedFramebufferDrawBuffers(framebuffer, static_cast<GLsizei>(count), buffers.data());
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, graph[resources.scene_depth].handle, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(view.width), static_cast<GLsizei>(view.height));
    glm::vec4 behind = view.backdrop == Backdrop::color ? view.background_linear : glm::vec4(0);
    const float opacity = std::clamp(behind.a, 0.0F, 1.0F);
    behind = glm::vec4(glm::vec3(behind) * opacity, opacity);
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &behind.x);
    for (std::size_t i = 1; i < count; ++i) {
        glClearNamedFramebufferfv(framebuffer, GL_COLOR, static_cast<GLint>(i), nothing.data());
    }
    if (view.host_depth != HostDepth::none) return;  // the host's depth was read into it
    const float far_depth = 1;
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far_depth);
}

void shade(FrameState& frame, const FrameGraph& graph) {
    DrawLists& lists = frame.own<DrawLists>();
    bind_targets(frame, graph);
    for (CharacterState* character : frame.characters) {
        if (!character->report->on_screen) continue;
        write_frame_block(frame, *character);
        if (frame.picture == 0) write_draw_blocks(*character);
    }
    forget_program(frame);
    bind_shared_maps(frame);

    glEnable(GL_DEPTH_TEST);
    draw_items(frame, lists.solid);
    draw_hair_cores(frame, lists.cores);
    glDepthFunc(GL_LEQUAL);  // a core is shaded where its own depth stands
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    // What blends over skin takes its share of the light that scatters, and adds none.
    for (GLuint i = 1; i < 4; ++i) glBlendFunci(i, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    glBlendEquation(GL_FUNC_ADD);
    glDepthMask(GL_FALSE);
    draw_items(frame, lists.blended);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
}

/// Every program that the lists need; a failure is reported and draws nothing.
void require_programs(FrameState& frame, const DrawLists& lists) {
    for (const std::vector<DrawItem>* items : {&lists.solid, &lists.blended}) {
        for (const DrawItem& item : *items) shade_program(frame.shared, item.permutation);
    }
    if (!lists.cores.empty()) require_hair_cores(frame, SeenFrom::camera);
}

}  // namespace

void declare_shade(FrameState& frame) {
    DrawLists& lists = frame.own<DrawLists>();
    list_draws(frame, lists);
    require_programs(frame, lists);
    FrameGraph& graph = frame.graph;
    graph.pass("shade", [&frame](const FrameGraph& made) { shade(frame, made); });
    for (const CharacterState* character : frame.characters) {
        graph.reads(character->resources.positions)
            .reads(character->resources.normals)
            .reads(character->resources.tangents);
        if (character->on(blood_effect)) graph.reads(character->resources.blood_change);
    }
    if (frame.on(shadows_effect)) graph.reads(frame.resources.shadow_maps);
    for (std::size_t i = 0; i < frame.resources.resolve_count; ++i) graph.writes(frame.resources.to_resolve[i].from);
    if (frame.view->host_depth == HostDepth::none) {
        graph.writes(frame.resources.scene_depth);
    } else {
        graph.modifies(frame.resources.scene_depth);
    }
}

}  // namespace blush
