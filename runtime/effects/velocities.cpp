/// How far every pixel's surface moved since the last frame: the deforming face, its nodes and joints, and the camera
/// (jimenez-2012, 10.4.4). A pass of its own over the geometry, before anything is shaded.

#include <array>

#include "runtime/antialias/last_frame.h"
#include "runtime/draw/draw_face.h"
#include "runtime/draw/hair_core.h"
#include "runtime/frame/frame.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/measure/antialiasing_study.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> source_choices = {"geometry", "none"};
constexpr std::array<Setting, 1> settings = {{
    {"source",
     "geometry: drawn from the surfaces of both frames; none: not known, and temporal modes fall back to frames that "
     "stand alone",
     source_choices, 0},
}};

struct Velocities {
    std::array<gl::Program, 2> programs;  // [with alpha test]
    gl::VertexArray vertex_array;
    gl::Framebuffer framebuffer;
    ResourceId depth{};
};

Need need(const CharacterState& state) {
    if (!state.sampling.temporal) {
        return {.on = false, .reason = "nothing takes from the last frame", .can_be_forced = false};
    }
    if (!state.facts.has_last_frame) {
        return {.on = false, .reason = "there is no last frame of this size and mode", .can_be_forced = false};
    }
    if (!state.facts.moves) return {.on = false, .reason = "nothing moves: every velocity is zero"};
    return {.on = true, .reason = "the face or the camera moved since the last frame"};
}

void attribute(const gl::VertexArray& array, GLuint location, GLint components, const gl::Buffer& buffer) {
    glEnableVertexArrayAttrib(array.name(), location);
    glVertexArrayAttribFormat(array.name(), location, components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array.name(), location, location);
    glVertexArrayVertexBuffer(array.name(), location, buffer.name(), 0,
                              static_cast<GLsizei>(static_cast<std::size_t>(components) * sizeof(float)));
}

void bind_surfaces(CharacterState& state, Velocities& own, const LastFrame& last) {
    if (!own.vertex_array) own.vertex_array = gl::make_vertex_array();
    attribute(own.vertex_array, BLUSH_POSITION_ATTRIBUTE, 3, state.surface->positions);
    attribute(own.vertex_array, BLUSH_LAST_POSITION_ATTRIBUTE, 3, last.positions);
    attribute(own.vertex_array, BLUSH_UV0_ATTRIBUTE, 2, state.model.uv0);
    attribute(own.vertex_array, BLUSH_UV1_ATTRIBUTE, 2, state.model.uv1);
    glVertexArrayElementBuffer(own.vertex_array.name(), state.model.indices.name());
}

void set_matrix(GLint location, const glm::mat4& matrix) { glUniformMatrix4fv(location, 1, GL_FALSE, &matrix[0].x); }

/// What blends is passed over, but for the core of hair: its velocity is that of what is behind it.
void draw_primitive(CharacterState& state, const Velocities& own, const LastFrame& last, const Primitive& primitive,
                    std::size_t node, bool mirrored) {
    const bool blended = is_blended(state.face, primitive);
    if (blended && !is_hair_card(state, primitive)) return;
    const Material* material =
        primitive.material >= 0 ? &state.face.materials[static_cast<std::size_t>(primitive.material)] : nullptr;
    const bool alpha_test =
        material != nullptr && material->alpha_mode != AlphaMode::opaque && material->base_color_srgb.image >= 0;
    if (alpha_test) state.model.bind_maps(state.face, primitive.material);
    glUseProgram(own.programs[alpha_test ? 1 : 0].name());

    const bool skinned = node == state.face.nodes.size();  // the surface stands in the world already
    set_matrix(0, state.camera.clip_from_view * state.camera.view_from_world);
    set_matrix(1, state.view->camera.clip_from_view * state.view->camera.view_from_world);
    set_matrix(2, last.stance.camera.clip_from_view * last.stance.camera.view_from_world);
    set_matrix(3, skinned ? glm::mat4(1) : state.world_from_node[node]);
    set_matrix(4, skinned ? glm::mat4(1) : last.stance.world_from_node[node]);

    if (material != nullptr && material->double_sided) {
        glDisable(GL_CULL_FACE);
    } else {
        glEnable(GL_CULL_FACE);
    }
    glFrontFace(mirrored ? GL_CW : GL_CCW);
    draw_elements(state, primitive);
}

void draw(CharacterState& state, const FrameGraph& graph) {
    Velocities& own = state.own<Velocities>();
    const LastFrame& last = state.own<LastFrame>();
    const GLuint framebuffer = own.framebuffer.name();
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, graph[state.resources.velocities].handle, 0);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, graph[own.depth].handle, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(state.view->width), static_cast<GLsizei>(state.view->height));
    const std::array<float, 4> still{};
    const float far_depth = 1;
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, still.data());
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far_depth);
    bind_surfaces(state, own, last);
    glBindVertexArray(own.vertex_array.name());
    glEnable(GL_DEPTH_TEST);
    each_drawn_primitive(state, [&](const Primitive& primitive, std::size_t node, bool mirrored) {
        draw_primitive(state, own, last, primitive, node, mirrored);
    });
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
}

void declare(CharacterState& state) {
    Velocities& own = state.own<Velocities>();
    constexpr std::array<std::string_view, 1> alpha_test = {"ALPHA_TEST"};
    gl::require_program(own.programs[0], {"antialias/velocities.vert", "antialias/velocities.frag"});
    gl::require_program(own.programs[1], {"antialias/velocities.vert", "antialias/velocities.frag", alpha_test});
    if (!own.framebuffer) own.framebuffer = gl::make_framebuffer();
    TextureShape shape{PixelFormat::rgba16f, state.view->width, state.view->height, 1};
    state.resources.velocities = state.graph.texture("velocities", shape);
    shape.format = PixelFormat::depth32f;
    own.depth = state.graph.texture("depth of velocities", shape);
    state.graph.pass("velocities", [&state](const FrameGraph& graph) { draw(state, graph); })
        .reads(state.resources.positions)
        .writes(state.resources.velocities)
        .writes(own.depth);
}

/// Of no use by themselves: what T2x makes of them is measured with it.
std::vector<Study> studies(const Device& /*device*/, const Face& /*face*/, double /*mm*/, bool /*quick*/) { return {}; }

constexpr std::array<HardCase, 1> hard_cases = {{
    {"a camera on the surface", "what was behind the camera has the largest velocity there is", [](Face&) {}, 1,
     [](View& view) { view.camera.view_from_world[3] = glm::vec4(0, 0, 0, 1); }},
}};

}  // namespace

const Effect velocities_effect = {
    .name = "velocities",
    .what = "how far each pixel's surface moved since the last frame",
    .settings = settings,
    .stage = Stage::light,
    .need = need,
    .declare = declare,
    .studies = studies,
    .hard_cases = hard_cases,
};

}  // namespace blush
