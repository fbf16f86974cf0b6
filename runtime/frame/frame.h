#pragma once
/// The one place where a frame is declared and run.

#include "runtime/frame/character_state.h"
#include "runtime/frame/effect.h"

namespace blush {

/// Evaluates the rig and brings the facts that predicates look at up to date.
void begin_frame(CharacterState& state, const View& view);

/// Asks every effect whether the scene needs it; the answers stand in the report and in CharacterState::on().
void find_needs(CharacterState& state);

/// Declares the passes of the effects of one stage that are on, in the registry's order.
void declare_stage(CharacterState& state, Stage stage);

/// Draws a frame; state.report says what was done.
void draw_frame(CharacterState& state, const View& view);

/// Runs the effects alone and leaves the deformed surface in its buffers.
void deform_only(CharacterState& state);

/// The picture as far as it has come, and the image that the calling step writes: for the last step the view's own
/// framebuffer, else a texture of picture_format(). Call once for each effect of the stages after `scene` that declares
/// itself.
struct DisplayImages {
    ResourceId from{}, to{};
};
DisplayImages next_display(CharacterState& state);

/// Binds the framebuffer that draws into `image` (a framebuffer or a single-sampled colour texture of the graph), with
/// the viewport of its size.
void bind_output(CharacterState& state, const FrameGraph& graph, ResourceId image);

/// One triangle over the whole of what is bound, with the program in use.
void draw_screen(const CharacterState& state);

/// Passes that every frame has, in passes/.
void declare_shade(CharacterState& state);
void declare_tone(CharacterState& state, ResourceId to);
void declare_copy(CharacterState& state, ResourceId from, ResourceId to);

}  // namespace blush
