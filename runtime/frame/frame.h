#pragma once
/// The one place where a frame is declared and run.

#include <span>

#include "runtime/frame/effect.h"
#include "runtime/frame/frame_state.h"

namespace blush {

/// Starts a frame of a scene: evaluates every character's rig and finds where it stands. Once, whatever the number of
/// views.
/// next: false where the frame before is only looked at again, as by deform_only().
void begin_scene_frame(SceneState& scene, bool next = true);
/// Keeps what the next frame compares itself with, after the last view.
void end_scene_frame(SceneState& scene, bool keep_surfaces);

/// Draws one view of the frame that begin_scene_frame() started; frame.report says what was done.
void draw_view(FrameState& frame, SceneState& scene, const ViewFrame& view);

/// Makes all that shading reads for a view, and leaves shading to the host.
void hand_over_view(FrameState& frame, SceneState& scene, const ViewFrame& view);

/// Makes the surfaces of a scene's characters, and nothing else.
void deform_only(FrameState& frame, SceneState& scene, bool forced = false);

/// Declares the passes of the effects of one stage that are on, in the registry's order.
void declare_stage(FrameState& frame, Stage stage);

/// The picture as far as it has come, and the image that the calling step writes. Call once for each step after the
/// scene.
struct DisplayImages {
    ResourceId from{}, to{};
};
DisplayImages next_display(FrameState& frame);

/// Binds the framebuffer that draws into `image` (a framebuffer or a single-sampled colour texture of the graph), with
/// the viewport of its size. Of a framebuffer of the host's only the first colour attachment is written.
void bind_output(FrameState& frame, const FrameGraph& graph, ResourceId image);

/// One triangle over the whole of what is bound, with the program in use.
void draw_screen(const FrameState& frame);

/// Passes that every frame has, in passes/. declare_copy: between textures.
void declare_shade(FrameState& frame);
/// In its place, where the host shades: blocks are filled, and all that shading reads is made.
void declare_host_shading(FrameState& frame);
void declare_tone(FrameState& frame, ResourceId to);
void declare_copy(FrameState& frame, ResourceId from, ResourceId to);
/// The host's depth into the scene's, before anything is shaded.
void declare_read_depth(FrameState& frame, ResourceId to);
/// The scene's depth into the host's.
void declare_write_depth(FrameState& frame, ResourceId target);
/// Velocities of what is seen into the framebuffer that the host has for them.
void declare_write_velocities(FrameState& frame);
/// A picture over what the host's framebuffer holds, or over its rectangle there.
void declare_compose(FrameState& frame, ResourceId from, ResourceId target);
/// Makes the device's CommonPasses where they are not there yet, and sets frame.common.
bool make_common_passes(FrameState& frame);

}  // namespace blush
