/// Draws the surface that the deformation left, lit, in linear HDR.

#include <cmath>
#include <cstring>

#include <glm/gtc/matrix_inverse.hpp>

#include "runtime/frame.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

/// Direction in the camera's frame (x right, y up, z towards the camera) to the world.
glm::vec4 world_direction(const glm::mat4& world_from_view, glm::vec3 direction_view) {
    return {glm::normalize(glm::mat3(world_from_view) * glm::normalize(direction_view)), 0};
}

/// Three-point lighting of a portrait, fixed to the camera: a warm key from the upper left, a cool weak fill from the
/// right, a rim from behind. Radiances in units of the white that exposure 1 shows a little below display white.
shared::FrameBlock frame_block(const Camera& camera) {
    const glm::mat4 world_from_view = glm::inverse(camera.view_from_world);
    shared::FrameBlock block{};
    block.clip_from_world = camera.clip_from_view * camera.view_from_world;
    block.camera_world = world_from_view[3];
    block.lights[0] = {world_direction(world_from_view, {-0.55F, 0.55F, 0.75F}), {1.75F, 1.62F, 1.48F, 0}};
    block.lights[1] = {world_direction(world_from_view, {0.9F, 0.05F, 0.55F}), {0.34F, 0.38F, 0.46F, 0}};
    block.lights[2] = {world_direction(world_from_view, {0.55F, 0.65F, -0.85F}), {0.9F, 0.97F, 1.05F, 0}};
    block.sky_radiance_linear = {0.20F, 0.215F, 0.24F, 0};
    block.ground_radiance_linear = {0.085F, 0.075F, 0.07F, 0};
    return block;
}

/// Cofactors of the upper left 3x3: the inverse transpose up to a positive factor, finite for every matrix.
glm::mat3 normal_matrix(const glm::mat4& matrix) {
    const glm::vec3 x(matrix[0]), y(matrix[1]), z(matrix[2]);
    const glm::mat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y));
    return glm::dot(x, cofactors[0]) < 0 ? -cofactors : cofactors;
}

void write_draw_blocks(CharacterState& state) {
    const auto write = [&](std::size_t index, const glm::mat4& world_from_mesh) {
        shared::DrawBlock block{};
        block.world_from_mesh = world_from_mesh;
        block.world_normal_from_mesh = glm::mat4(normal_matrix(world_from_mesh));
        std::memcpy(&state.model.draw_staging[index * state.model.draw_stride], &block, sizeof(block));
    };
    for (std::size_t n = 0; n < state.face.nodes.size(); ++n) write(n, state.world_from_node[n]);
    write(state.face.nodes.size(), glm::mat4(1));
    glNamedBufferSubData(state.model.draw_blocks.name(), 0, static_cast<GLsizeiptr>(state.model.draw_staging.size()),
                         state.model.draw_staging.data());
}

void draw_primitive(CharacterState& state, const Primitive& primitive, std::size_t draw_index, bool mirrored) {
    const std::int32_t material = primitive.material;
    const bool double_sided = material >= 0 && state.face.materials[static_cast<std::size_t>(material)].double_sided;
    state.model.bind_draw(draw_index);
    state.model.bind_material(state.face, material);
    if (double_sided) {
        glDisable(GL_CULL_FACE);
    } else {
        glEnable(GL_CULL_FACE);
    }
    glFrontFace(mirrored ? GL_CW : GL_CCW);
    const std::size_t offset_bytes = std::size_t{primitive.first_index} * sizeof(std::uint32_t);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(primitive.index_count), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(offset_bytes));  // NOLINT(performance-no-int-to-ptr): GL's own way
    state.report.triangles_drawn += primitive.index_count / 3;
}

bool blends(const CharacterState& state, const Primitive& primitive) {
    return primitive.material >= 0 &&
           state.face.materials[static_cast<std::size_t>(primitive.material)].alpha_mode == AlphaMode::blend;
}

/// Every primitive of every node that draws; of a skinned mesh the surface stands in the world already.
void draw_nodes(CharacterState& state, bool blended) {
    for (std::size_t n = 0; n < state.face.nodes.size(); ++n) {
        const Node& node = state.face.nodes[n];
        if (node.mesh < 0) continue;
        const Mesh& mesh = state.face.meshes[static_cast<std::size_t>(node.mesh)];
        const bool skinned = node.skin >= 0 && state.facts.has_joints;
        const bool mirrored = !skinned && glm::determinant(glm::mat3(state.world_from_node[n])) < 0;
        for (std::uint32_t p = 0; p < mesh.primitive_count; ++p) {
            const Primitive& primitive = state.face.primitives[mesh.first_primitive + p];
            if (primitive.index_count == 0 || blends(state, primitive) != blended) continue;
            draw_primitive(state, primitive, skinned ? state.face.nodes.size() : n, mirrored);
        }
    }
}

void shade(CharacterState& state, const FrameGraph& graph) {
    const View& view = *state.view;
    const GLuint framebuffer = state.scene_framebuffer.name();
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, graph[state.resources.scene_color_multisampled].handle,
                              0);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, graph[state.resources.scene_depth].handle, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(view.width), static_cast<GLsizei>(view.height));
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &view.background_linear.x);
    const float far_depth = 1;
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far_depth);

    const shared::FrameBlock block = frame_block(state.camera);
    glNamedBufferSubData(state.model.frame_block.name(), 0, sizeof(block), &block);
    write_draw_blocks(state);
    glBindBufferBase(GL_UNIFORM_BUFFER, BLUSH_FRAME_BINDING, state.model.frame_block.name());
    state.model.bind_surface(*state.surface);

    glEnable(GL_DEPTH_TEST);
    draw_nodes(state, false);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glBlendEquation(GL_FUNC_ADD);
    glDepthMask(GL_FALSE);
    draw_nodes(state, true);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
}

}  // namespace

void declare_shade(CharacterState& state) {
    state.graph.pass("shade", [&state](const FrameGraph& graph) { shade(state, graph); })
        .reads(state.resources.positions)
        .reads(state.resources.normals)
        .reads(state.resources.tangents)
        .writes(state.resources.scene_color_multisampled)
        .writes(state.resources.scene_depth);
}

}  // namespace blush
