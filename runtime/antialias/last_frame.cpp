#include "runtime/antialias/last_frame.h"

#include <algorithm>

#include "runtime/antialias/pictures.h"
#include "runtime/frame/frame.h"
#include "runtime/gl/texture_pool.h"

namespace blush {
namespace {

gl::Texture make_kept_texture(PixelFormat format, const TextureShape& shape) {
    gl::Texture texture = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.name(), 1, stored_format(format), static_cast<GLsizei>(shape.width),
                       static_cast<GLsizei>(shape.height));
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace

bool compares_frames(const FrameState& frame, const ViewFrame& view) {
    return frame.sampling.temporal || view.velocity_framebuffer != 0;
}

void find_last_frame(FrameState& frame, const ViewFrame& view) {
    LastFrame& last = frame.own<LastFrame>();
    for (CharacterState* character : frame.characters) character->moves = false;
    if (!compares_frames(frame, view)) {
        if (last.known || last.images[0].color) last = {};
        return;
    }
    if (!frame.sampling.temporal) last.images = {};
    const TextureShape shape{picture_format(view.output), view.width, view.height, 1};
    // One whose surface is not known as it was in the last frame makes this one a cut.
    const bool same_characters = last.scene == frame.scene && last.scene_frame + 1 == frame.scene->frame &&
                                 std::ranges::equal(last.characters, frame.characters) &&
                                 std::ranges::all_of(frame.characters, [&last](const CharacterState* character) {
                                     return character->last.frame == last.scene_frame;
                                 });
    last.known = last.known && same_characters && !view.cut && last.sampling == frame.sampling && last.shape == shape;
    last.shape = shape;
    last.sampling = frame.sampling;
    last.phase = last.known ? 1 - last.phase : 0;
    last.images[last.phase].has_speeds = false;
    frame.facts.has_last_frame = last.known;
    if (!last.known) return;
    const bool same_camera = last.camera.view_from_world == view.camera.view_from_world &&
                             last.camera.clip_from_view == frame.clip_from_view;
    for (CharacterState* character : frame.characters) {
        character->moves = !(character->last.stance == character->stance);
        frame.facts.moves |= character->moves;
    }
    frame.facts.moves |= !same_camera;
}

KeptImage& kept_image(FrameState& frame, const TextureShape& shape) {
    LastFrame& last = frame.own<LastFrame>();
    KeptImage& kept = last.images[last.phase];
    if (!kept.color || kept.shape != shape) {
        kept.color = make_kept_texture(shape.format, shape);
        kept.speeds = make_kept_texture(PixelFormat::r16f, shape);
        kept.depth = make_kept_texture(PixelFormat::depth32f, shape);
        kept.shape = shape;
    }
    return kept;
}

ResourceId import_kept_speeds(FrameState& frame) {
    TextureShape shape{picture_format(frame.view->output), frame.view->width, frame.view->height, 1};
    KeptImage& kept = kept_image(frame, shape);
    kept.has_speeds = true;
    shape.format = PixelFormat::r16f;
    return frame.graph.import_texture("kept speeds", kept.speeds.name(), shape);
}

void keep_display(FrameState& frame) {
    const TextureShape shape{picture_format(frame.view->output), frame.view->width, frame.view->height, 1};
    const ResourceId kept = frame.graph.import_texture("kept image", kept_image(frame, shape).color.name(), shape);
    if (frame.resources.display == frame.resources.scene_color) {
        declare_copy(frame, frame.resources.display, kept);
    } else {
        frame.graph.forward(frame.resources.display, kept);
    }
    frame.resources.display = kept;
}

ResourceId import_kept_depth(FrameState& frame, TextureShape shape) {
    KeptImage& kept = kept_image(frame, {picture_format(frame.view->output), frame.view->width, frame.view->height, 1});
    shape.format = PixelFormat::depth32f;
    return frame.graph.import_texture("scene depth", kept.depth.name(), shape);
}

void keep_for_next_frame(FrameState& frame) {
    if (!compares_frames(frame, *frame.view)) return;
    LastFrame& last = frame.own<LastFrame>();
    last.scene = frame.scene;
    last.scene_frame = frame.scene->frame;
    last.characters.assign(frame.characters.begin(), frame.characters.end());
    last.camera = frame.view->camera;
    last.camera.clip_from_view = frame.clip_from_view;
    last.known = true;
}

void keep_surface(CharacterState& character, std::uint64_t scene_frame) {
    LastSurface& last = character.last;
    const auto bytes = static_cast<GLsizeiptr>(character.face.positions.size() * sizeof(glm::vec3));
    const bool stale = last.frame == 0 || !(last.stance == character.stance);
    if (!last.positions) last.positions = gl::make_buffer(static_cast<std::size_t>(bytes), nullptr);
    // A copy, and not two buffers in turn: the deformation of an unchanged frame is not run, and its result stays put.
    if (stale && bytes != 0)
        glCopyNamedBufferSubData(character.surface->positions.name(), last.positions.name(), 0, 0, bytes);
    last.stance = character.stance;
    last.frame = scene_frame;
}

}  // namespace blush
