/// Draws the surface that the deformation left, lit, in linear HDR.

#include <algorithm>
#include <array>
#include <cassert>
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

/// What of shading this frame asks for, as bits of the permutation.
std::uint32_t frame_bits(const CharacterState& state) {
    std::uint32_t bits = 0;
    if (state.on(scattering_effect)) bits |= shade_scatter;
    if (state.on(reflection_effect)) bits |= shade_skin_reflection;
    if (state.shadows_shown) bits |= shade_shadows;
    if (state.translucency_shown) bits |= shade_translucency;
    if (state.on(wrinkles_effect)) {
        const bool differences = state.settings.choice(wrinkles_effect.name, "encoding") == 1;
        bits |= differences ? shade_wrinkles | shade_wrinkle_differences : shade_wrinkles;
    }
    if (state.on(blood_effect)) bits |= colour_from_pigments(state) ? shade_blood | shade_pigment_colour : shade_blood;
    if (state.on(environment_effect)) bits |= shade_environment;
    if (state.on(occlusion_effect)) bits |= shade_ambient_occlusion;
    if (state.on(parts_effect)) bits |= parts_bits(state);
    return bits;
}

/// T(s) of the material: jimenez-2012, eq. 5.12, as it follows from the profile or as it is printed.
void write_profile(const CharacterState& state, shared::FrameBlock& block) {
    const std::span<const GaussianTerm> profile = scatter_profile(state);
    const bool derived = state.settings.choice(translucency_effect.name, "attenuation") == 0;
    for (std::size_t k = 0; k < profile.size(); ++k) {
        const double exponent = -1 / ((derived ? 2 : 1) * profile[k].variance_mm2);
        block.profile[k] = glm::vec4(glm::vec3(profile[k].weight), static_cast<float>(exponent));
    }
    // Four standard deviations of the widest: less than a thousandth of anything passes.
    block.translucency.z = static_cast<float>(4 * std::sqrt(profile.back().variance_mm2));
}

shared::FrameBlock frame_block(CharacterState& state) {
    const Camera& camera = state.camera;
    shared::FrameBlock block{};
    block.clip_from_world = camera.clip_from_view * camera.view_from_world;
    block.camera_world = glm::inverse(camera.view_from_world)[3];
    const glm::mat4 rows = glm::transpose(camera.view_from_world);
    block.depth_from_world = -rows[2];
    block.sky_radiance_linear = glm::vec4(state.lighting->sky_radiance_linear, 0);
    block.ground_radiance_linear = glm::vec4(state.lighting->ground_radiance_linear, 0);
    write_ambient(state, block);
    if (state.on(occlusion_effect)) write_occlusion_weights(state, block);
    const auto number = [&state](const Effect& effect, std::string_view setting) {
        return static_cast<float>(state.settings.number(effect.name, setting));
    };
    block.skin = {static_cast<float>(state.millimetres_a_unit), number(scattering_effect, "albedo_before"),
                  number(reflection_effect, "roughness"), number(reflection_effect, "intensity")};
    block.translucency = {number(translucency_effect, "strength"), number(translucency_effect, "drawn_in_mm"), 0, 0};
    if (state.on(parts_effect)) write_parts(state, block);
    write_profile(state, block);
    block.counts.x = static_cast<int>(state.shader_lights.size());
    std::ranges::copy(state.shader_lights, block.lights);
    return block;
}

void bind_maps(CharacterState& state, std::uint32_t bits) {
    if ((bits & shade_skin_reflection) != 0) {
        const SkinTables& tables = skin_tables(state);
        glBindTextureUnit(BLUSH_BECKMANN_UNIT, tables.beckmann.name());
        glBindTextureUnit(BLUSH_SPECULAR_ALBEDO_UNIT, tables.specular_albedo.name());
    }
    if ((bits & shade_environment) != 0) bind_environment(state);
    if ((bits & shade_ambient_occlusion) != 0) bind_occlusion(state);
    bind_appearance(state, (bits & shade_wrinkles) != 0, (bits & shade_blood) != 0);
    if ((bits & shade_shadows) != 0) {
        const auto& maps = state.own<ShadowMaps>();
        glBindTextureUnit(BLUSH_SHADOW_UNIT, maps.depth.name());
        glBindSampler(BLUSH_SHADOW_UNIT, maps.nearest.name());
    }
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

void draw_primitive(CharacterState& state, const Primitive& primitive, std::size_t draw_index, bool mirrored,
                    std::uint32_t bits) {
    const std::int32_t material = primitive.material;
    const std::size_t index = material >= 0 ? static_cast<std::size_t>(material) : state.face.materials.size();
    state.model.bind_draw(draw_index);
    state.model.bind_material(state.face, material, state.material_kind[index], bits);
    cull(state.face, primitive, mirrored);
    draw_elements(state, primitive);
}

void draw_nodes(CharacterState& state, bool blended, std::uint32_t bits) {
    each_drawn_primitive(state, [&](const Primitive& primitive, std::size_t draw_index, bool mirrored) {
        if (is_blended(state.face, primitive) == blended) draw_primitive(state, primitive, draw_index, mirrored, bits);
    });
}

/// Writes the depth of blended hair where it is dense, after all that is solid.
void draw_hair_cores(CharacterState& state) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    each_drawn_primitive(state, [&](const Primitive& primitive, std::size_t draw_index, bool mirrored) {
        if (!is_blended(state.face, primitive) || !is_hair_card(state, primitive)) return;
        bind_hair_core(state, primitive, SeenFrom::camera);
        state.model.bind_draw(draw_index);
        cull(state.face, primitive, mirrored);
        draw_elements(state, primitive);
    });
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

/// Attaches what shading writes and clears it.
void bind_targets(CharacterState& state, const FrameGraph& graph) {
    const View& view = *state.view;
    const GLuint framebuffer = state.scene_framebuffer.name();
    const std::size_t count = state.on(scattering_effect) ? 4 : 1;
    const FrameResources& resources = state.resources;
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
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &view.background_linear.x);
    for (std::size_t i = 1; i < count; ++i) {
        glClearNamedFramebufferfv(framebuffer, GL_COLOR, static_cast<GLint>(i), nothing.data());
    }
    const float far_depth = 1;
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far_depth);
}

void shade(CharacterState& state, const FrameGraph& graph) {
    const std::uint32_t bits = frame_bits(state);
    [[maybe_unused]] const Status prepared = state.model.prepare(state.face, state.material_kind, bits);
    assert(prepared && "shade: a permutation of face.frag does not compile");
    bind_targets(state, graph);

    const shared::FrameBlock block = frame_block(state);
    glNamedBufferSubData(state.model.frame_block.name(), 0, sizeof(block), &block);
    write_draw_blocks(state);
    glBindBufferBase(GL_UNIFORM_BUFFER, BLUSH_FRAME_BINDING, state.model.frame_block.name());
    state.model.bind_surface(*state.surface);
    bind_maps(state, bits);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BLUSH_SURFACE_POSITIONS_BINDING, state.surface->positions.name());

    glEnable(GL_DEPTH_TEST);
    draw_nodes(state, false, bits);
    draw_hair_cores(state);
    glDepthFunc(GL_LEQUAL);  // a core is shaded where its own depth stands
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    // What blends over skin takes its share of the light that scatters, and adds none.
    for (GLuint i = 1; i < 4; ++i) glBlendFunci(i, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    glBlendEquation(GL_FUNC_ADD);
    glDepthMask(GL_FALSE);
    draw_nodes(state, true, bits);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
}

}  // namespace

void declare_shade(CharacterState& state) {
    state.graph.pass("shade", [&state](const FrameGraph& graph) { shade(state, graph); })
        .reads(state.resources.positions)
        .reads(state.resources.normals)
        .reads(state.resources.tangents);
    if (state.shadows_shown) state.graph.reads(state.resources.shadow_maps);
    if (state.on(blood_effect)) state.graph.reads(state.resources.blood_change);
    for (std::size_t i = 0; i < state.resources.resolve_count; ++i) {
        state.graph.writes(state.resources.to_resolve[i].from);
    }
    state.graph.writes(state.resources.scene_depth);
}

}  // namespace blush
