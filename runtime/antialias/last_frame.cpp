#include "runtime/antialias/last_frame.h"

#include <algorithm>

#include "runtime/antialias/pictures.h"
#include "runtime/frame/character_state.h"
#include "runtime/gl/texture_pool.h"

namespace blush {
namespace {

bool same_stance(const CharacterState& state, const View& view, const Stance& stance) {
    return stance.active == state.active && stance.world_from_node == state.world_from_node &&
           stance.skinned_from_mesh == state.skinned_from_mesh && stance.camera == view.camera;
}

gl::Texture make_kept_texture(PixelFormat format, const TextureShape& shape) {
    gl::Texture texture = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.name(), 1, stored_format(format), static_cast<GLsizei>(shape.width),
                       static_cast<GLsizei>(shape.height));
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace

void find_last_frame(CharacterState& state, const View& view) {
    LastFrame& last = state.own<LastFrame>();
    if (!state.sampling.temporal) {
        if (last.positions) last = {};
        return;
    }
    const TextureShape& shape = last.images[last.phase].shape;
    const PixelFormat format = picture_format(view.output);
    last.known = last.known && !view.cut && last.sampling == state.sampling && shape.format == format &&
                 shape.width == view.width && shape.height == view.height;
    last.sampling = state.sampling;
    last.phase = last.known ? 1 - last.phase : 0;
    last.images[last.phase].has_speeds = false;
    state.facts.has_last_frame = last.known;
    state.facts.moves = last.known && !same_stance(state, view, last.stance);
}

KeptImage& kept_image(CharacterState& state, const TextureShape& shape) {
    LastFrame& last = state.own<LastFrame>();
    KeptImage& kept = last.images[last.phase];
    if (!kept.color || kept.shape != shape) {
        kept.color = make_kept_texture(shape.format, shape);
        kept.speeds = make_kept_texture(PixelFormat::r16f, shape);
        kept.depth = make_kept_texture(PixelFormat::depth32f, shape);
        kept.shape = shape;
    }
    return kept;
}

ResourceId import_kept_speeds(CharacterState& state) {
    TextureShape shape{picture_format(state.view->output), state.view->width, state.view->height, 1};
    KeptImage& kept = kept_image(state, shape);
    kept.has_speeds = true;
    shape.format = PixelFormat::r16f;
    return state.graph.import_texture("kept speeds", kept.speeds.name(), shape);
}

ResourceId import_kept_depth(CharacterState& state, TextureShape shape) {
    KeptImage& kept = kept_image(state, {picture_format(state.view->output), state.view->width, state.view->height, 1});
    shape.format = PixelFormat::depth32f;
    return state.graph.import_texture("scene depth", kept.depth.name(), shape);
}

void keep_for_next_frame(CharacterState& state, const View& view) {
    if (!state.sampling.temporal) return;
    LastFrame& last = state.own<LastFrame>();
    const auto bytes = static_cast<GLsizeiptr>(state.face.positions.size() * sizeof(glm::vec3));
    const bool stale = !last.known || state.facts.moves;
    if (!last.positions) last.positions = gl::make_buffer(static_cast<std::size_t>(bytes), nullptr);
    // A copy, and not two buffers in turn: the deformation of an unchanged frame is not run, and its result stays put.
    if (stale && bytes != 0)
        glCopyNamedBufferSubData(state.surface->positions.name(), last.positions.name(), 0, 0, bytes);
    last.stance = {state.active, state.world_from_node, state.skinned_from_mesh, view.camera};
    last.known = true;
}

}  // namespace blush
