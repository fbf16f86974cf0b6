/// How far every pixel's surface moved since the last frame: the deforming face, its nodes and joints, and the camera
/// (jimenez-2012, 10.4.4). A pass of its own over the geometry, before anything is shaded.

#include <array>

#include "runtime/antialias/last_frame.h"
#include "runtime/draw/draw_face.h"
#include "runtime/draw/hair_core.h"
#include "runtime/effects/effects.h"
#include "runtime/effects/shared_settings.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/own_setting.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> source_choices = {"geometry", "none"};
constexpr std::array<Setting, 1> settings = {{
    {"source",
     "geometry: drawn from the surfaces of both frames; none: not known, and temporal modes fall back to frames that "
     "stand alone",
     source_choices, 0},
}};
using Own = OwnSetting<velocities_effect, settings>;

struct Velocities {
    std::array<gl::Program, 2> programs;  // [with alpha test]
    gl::VertexArray vertex_array;
    gl::Framebuffer framebuffer;
    ResourceId depth{};
};

Need need(const FrameState& frame) {
    if (!compares_frames(frame, *frame.view)) {
        return {.on = false, .reason = "nothing asks how the picture moved", .can_be_forced = false};
    }
    if (!frame.facts.has_last_frame) {
        return {.on = false, .reason = "there is no last frame of this size and mode", .can_be_forced = false};
    }
    if (frame.view->velocity_framebuffer != 0) return {.on = true, .reason = "the host asks how the picture moves"};
    if (!frame.facts.moves) return {.on = false, .reason = "nothing moves: every velocity is zero"};
    return {.on = true, .reason = "the face or the camera moved since the last frame"};
}

void attribute(const gl::VertexArray& array, GLuint location, GLint components, const gl::Buffer& buffer) {
    glEnableVertexArrayAttrib(array.name(), location);
    glVertexArrayAttribFormat(array.name(), location, components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array.name(), location, location);
    glVertexArrayVertexBuffer(array.name(), location, buffer.name(), 0,
                              static_cast<GLsizei>(static_cast<std::size_t>(components) * sizeof(float)));
}

void bind_surfaces(Velocities& own, const CharacterState& character) {
    if (!own.vertex_array) own.vertex_array = gl::make_vertex_array();
    attribute(own.vertex_array, BLUSH_POSITION_ATTRIBUTE, 3, character.surface->positions);
    attribute(own.vertex_array, BLUSH_LAST_POSITION_ATTRIBUTE, 3, character.last.positions);
    attribute(own.vertex_array, BLUSH_UV0_ATTRIBUTE, 2, character.model->uv0);
    attribute(own.vertex_array, BLUSH_UV1_ATTRIBUTE, 2, character.model->uv1);
    glVertexArrayElementBuffer(own.vertex_array.name(), character.model->indices.name());
}

void set_matrix(GLint location, const glm::dmat4& matrix) {
    const glm::mat4 single(matrix);
    glUniformMatrix4fv(location, 1, GL_FALSE, &single[0].x);
}

/// What blends is passed over, but for the core of hair: its velocity is that of what is behind it.
void draw_primitive(FrameState& frame, CharacterState& character, const Velocities& own, const Camera& last,
                    const Primitive& primitive, std::size_t node, bool mirrored, bool with_alpha_test) {
    const bool blended = is_blended(character.face, primitive);
    if (blended && !is_hair_card(character, primitive)) return;
    const Material* material =
        primitive.material >= 0 ? &character.face.materials[static_cast<std::size_t>(primitive.material)] : nullptr;
    const bool alpha_test =
        material != nullptr && material->alpha_mode != AlphaMode::opaque && material->base_color_srgb.image >= 0;
    if (alpha_test != with_alpha_test) return;
    if (alpha_test) character.model->bind_maps(primitive.material, base_color_texture);
    use_program(frame, own.programs[alpha_test ? 1 : 0]);

    const glm::dmat4& world_from_mesh = character.stance.world_from_node[node];
    const glm::dmat4 view_from_mesh = frame.view->camera.view_from_world * world_from_mesh;
    set_matrix(0, glm::dmat4(frame.camera.clip_from_view) * view_from_mesh);
    set_matrix(1, glm::dmat4(frame.clip_from_view) * view_from_mesh);
    set_matrix(2,
               glm::dmat4(last.clip_from_view) * (last.view_from_world * character.last.stance.world_from_node[node]));

    if (material != nullptr && material->double_sided) {
        glDisable(GL_CULL_FACE);
    } else {
        glEnable(GL_CULL_FACE);
    }
    glFrontFace(mirrored ? GL_CW : GL_CCW);
    draw_elements(frame, character, primitive);
}

void draw(FrameState& frame, const FrameGraph& graph) {
    Velocities& own = frame.shared_own<Velocities>();
    const Camera& last = frame.own<LastFrame>().camera;
    const GLuint framebuffer = own.framebuffer.name();
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, graph[frame.resources.velocities].handle, 0);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, graph[own.depth].handle, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(frame.view->width), static_cast<GLsizei>(frame.view->height));
    const std::array<float, 4> still{};
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, still.data());
    if (frame.view->host_depth == HostDepth::none) {
        const float far_depth = 1;
        glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far_depth);
    }
    glEnable(GL_DEPTH_TEST);
    forget_program(frame);
    for (const bool with_alpha_test : {false, true}) {  // a program each, whatever the number of characters
        for (CharacterState* character : frame.characters) {
            if (!character->report->on_screen) continue;
            bind_surfaces(own, *character);
            glBindVertexArray(own.vertex_array.name());
            each_drawn_primitive(*character, [&](const Primitive& primitive, std::size_t node, bool mirrored) {
                draw_primitive(frame, *character, own, last, primitive, node, mirrored, with_alpha_test);
            });
        }
    }
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
}

void declare(FrameState& frame) {
    Velocities& own = frame.shared_own<Velocities>();
    constexpr std::array<std::string_view, 2> alpha_test = {"ALPHA_TEST", "BASE_COLOR_MAP 0"};
    gl::require_program(own.programs[0], {"antialias/velocities.vert", "antialias/velocities.frag"});
    gl::require_program(own.programs[1], {"antialias/velocities.vert", "antialias/velocities.frag", alpha_test});
    if (!own.framebuffer) own.framebuffer = gl::make_framebuffer();
    TextureShape shape{PixelFormat::rgba16f, frame.view->width, frame.view->height, 1};
    frame.resources.velocities = frame.graph.texture("velocities", shape);
    shape.format = PixelFormat::depth32f;
    own.depth = frame.graph.texture("depth of velocities", shape);
    const bool hidden_by_host = frame.view->host_depth != HostDepth::none;
    if (hidden_by_host) declare_read_depth(frame, own.depth);
    frame.graph.pass("velocities", [&frame](const FrameGraph& graph) { draw(frame, graph); });
    for (const CharacterState* character : frame.characters) frame.graph.reads(character->resources.positions);
    frame.graph.writes(frame.resources.velocities);
    if (hidden_by_host) {
        frame.graph.modifies(own.depth);
    } else {
        frame.graph.writes(own.depth);
    }
    const bool last_picture = frame.picture + 1 == frame.sampling.pictures;
    if (last_picture && frame.view->velocity_framebuffer != 0) declare_write_velocities(frame);
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"a camera on the surface", "what was behind the camera has the largest velocity there is", [](Face&) {}, 1,
     [](ViewFrame& view) { view.camera.view_from_world[3] = glm::dvec4(0, 0, 0, 1); }},
}};

}  // namespace

constinit const SettingId velocities_source = Own("source");

const Effect velocities_effect = {
    .name = "velocities",
    .what = "how far each pixel's surface moved since the last frame",
    .settings = settings,
    .owner = SettingOwner::view,
    .stage = Stage::light,
    .need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
