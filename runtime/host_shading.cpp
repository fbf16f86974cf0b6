#include <algorithm>
#include <optional>

#include "runtime/draw/draw_face.h"
#include "runtime/draw/shading.h"
#include "runtime/frame/frame.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/gl/state_guard.h"
#include "runtime/scene.h"

namespace blush {
namespace {

struct Drawn {
    const Primitive* primitive = nullptr;
    std::size_t draw_index = 0;
};

/// The primitive of a character of the view's last frame, in the order in which nodes draw.
Result<Drawn> find_drawn(const FrameState& frame, CharacterState& character, std::size_t primitive) {
    if (std::ranges::find(frame.characters, &character) == frame.characters.end())
        return Error{"the character is not of the frame that the view was prepared for"};
    std::optional<Drawn> found;
    std::size_t index = 0;
    each_drawn_primitive(character, [&](const Primitive& each, std::size_t draw_index, bool) {
        if (index++ == primitive) found = Drawn{&each, draw_index};
    });
    if (found) return *found;
    return Error{"the character draws " + std::to_string(index) + " primitives; there is no number " +
                 std::to_string(primitive)};
}

}  // namespace

const FrameReport& Scene::prepare(View& view, const ViewFrame& frame) {
    state_->device.make_current();
    const gl::DrawScope guard(state_->device.state().kept_states == 0);
    begin_scene_frame(*state_);
    hand_over_view(view.state(), *state_, frame);
    end_scene_frame(*state_, false);
    return report(view);
}

Result<ShadingText> Scene::shading_text(View& view, const Character& character, std::size_t primitive) {
    CharacterState& state = *character.shared_state();
    const Result<Drawn> drawn = find_drawn(view.state(), state, primitive);
    if (!drawn) return drawn.error();
    const ShadingSource source =
        shading_source(state.device.state(), permutation_of(state, drawn->primitive->material));
    const std::vector<std::string_view> defines(source.defines.begin(), source.defines.end());
    Result<std::string> vertex = gl::expand_shader("draw/face.vert", defines, &source.insertions);
    if (!vertex) return vertex.error();
    Result<std::string> fragment = gl::expand_shader("draw/host.glsl", defines, &source.insertions);
    if (!fragment) return fragment.error();
    return ShadingText{*std::move(vertex), *std::move(fragment)};
}

Status Scene::bind_shading(View& view, const Character& character, std::size_t primitive) {
    CharacterState& state = *character.shared_state();
    const Result<Drawn> drawn = find_drawn(view.state(), state, primitive);
    if (!drawn) return drawn.error();
    const Permutation permutation = permutation_of(state, drawn->primitive->material);
    glBindBufferBase(GL_UNIFORM_BUFFER, BLUSH_FRAME_BINDING, state.frame_block.name());
    state.model->bind_surface(*state.surface);
    bind_effects(view.state(), state, permutation);
    state.draw_blocks.bind(drawn->draw_index);
    state.model->bind_maps(drawn->primitive->material, permutation.textures);
    return Done{};
}

}  // namespace blush
