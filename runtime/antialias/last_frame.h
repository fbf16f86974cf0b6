#pragma once
/// What a temporal mode keeps from frame to frame. Other modes keep nothing: all of it is given back.

#include <array>
#include <vector>

#include "rig/deform/blend_shapes.h"
#include "runtime/antialias/sampling.h"
#include "runtime/frame/frame_graph.h"
#include "runtime/gl/object.h"
#include "runtime/view.h"

namespace blush {

struct CharacterState;

/// All that decides where each point of the face stands on the screen.
struct Stance {
    std::vector<ActiveTarget> active;
    std::vector<glm::mat4> world_from_node, skinned_from_mesh;
    Camera camera;

    bool operator==(const Stance&) const = default;
};

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
    std::uint32_t phase = 0;  ///< of this frame: 0 and 1 in turn
    Stance stance;
    gl::Buffer positions;             ///< of every vertex, as the last frame's surface passes left them
    std::array<KeptImage, 2> images;  ///< [phase]: of this frame, [1 - phase]: of the last
};

/// Settles whether there is a last frame for this one (facts.has_last_frame, facts.moves), and gives back what a mode
/// that is not temporal does not need. Call once state.sampling is known.
void find_last_frame(CharacterState& state, const View& view);

/// The image of this frame to keep, made where it is missing or of another shape.
KeptImage& kept_image(CharacterState& state, const TextureShape& shape);

/// The speeds of this frame to keep, as a resource of the graph that is written to.
ResourceId import_kept_speeds(CharacterState& state);

/// The depth of this frame's last picture, as a resource of the graph that is written to.
ResourceId import_kept_depth(CharacterState& state, TextureShape shape);

/// After the frame has run: what the next one compares itself with.
void keep_for_next_frame(CharacterState& state, const View& view);

}  // namespace blush
