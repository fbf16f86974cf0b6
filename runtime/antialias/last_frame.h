#pragma once
/// What a temporal mode keeps from frame to frame, and a view that tells velocities. Others keep nothing: all of it is
/// given back.

#include <array>
#include <vector>

#include "rig/deform/blend_shapes.h"
#include "runtime/antialias/sampling.h"
#include "runtime/frame/frame_graph.h"
#include "runtime/gl/object.h"
#include "runtime/view.h"

namespace blush {

struct CharacterState;
struct FrameState;
struct SceneState;

/// A frame before it was blended with the one before it.
struct KeptImage {
    gl::Texture color;        ///< display values, or radiance
    gl::Texture speeds;       ///< r16f: lengths of the velocities, filtered along with the colour
    gl::Texture depth;        ///< depth32f: of the frame's last picture, which draws into it
    TextureShape shape;       ///< of color
    bool has_speeds = false;  ///< false: nothing moved, every speed is zero
};

struct LastFrame {
    bool known = false;  ///< there was a frame before this one, of the same size and sampling
    Sampling sampling;
    TextureShape shape;             ///< of its picture
    std::uint32_t phase = 0;        ///< of this frame: 0 and 1 in turn
    std::uint64_t scene_frame = 0;  ///< SceneState::frame of it
    const SceneState* scene = nullptr;
    std::vector<const CharacterState*> characters;
    Camera camera;                    ///< GL's own convention, not moved
    std::array<KeptImage, 2> images;  ///< of a temporal mode; [phase]: of this frame, [1 - phase]: of the last
};

/// Whether a view compares its frame with the one before it.
bool compares_frames(const FrameState& frame, const ViewFrame& view);

/// Settles whether there is a last frame for this one (facts.has_last_frame, facts.moves), and gives back what a mode
/// that is not temporal does not need. Call once frame.sampling is known.
void find_last_frame(FrameState& frame, const ViewFrame& view);

/// The image of this frame to keep, made where it is missing or of another shape.
KeptImage& kept_image(FrameState& frame, const TextureShape& shape);

/// The speeds of this frame to keep, as a resource of the graph that is written to.
ResourceId import_kept_speeds(FrameState& frame);

/// The picture as far as it has come is kept for the next frame.
void keep_display(FrameState& frame);

/// The depth of this frame's last picture, as a resource of the graph that is written to.
ResourceId import_kept_depth(FrameState& frame, TextureShape shape);

/// After the frame has run: what the next one compares itself with.
void keep_for_next_frame(FrameState& frame);

/// Keeps where a character's surface is, after all views of a frame.
void keep_surface(CharacterState& character, std::uint64_t scene_frame);

}  // namespace blush
