#pragma once
/// The pinned surface of one character: what the host pins, and the buffers that come of it.

#include <cstdint>
#include <vector>

#include "rig/deform/blend_shapes.h"
#include "rig/deform/pinning.h"
#include "runtime/deform/stream_out.h"
#include "runtime/settings.h"

namespace blush {

struct CharacterState;

struct PinnedSurface {
    std::vector<std::uint32_t> vertices;
    std::vector<std::size_t> entry;  ///< of each: Stance::world_from_node that its surface is drawn with
    std::vector<PinnedVertex> ring;
    std::vector<glm::vec3> positions_face, normals_face;  ///< as the host gave them; empty: not yet

    std::vector<Pin> pins;     ///< the same in the space of the surface's buffers, as the nodes stand in this frame
    std::uint64_t number = 0;  ///< of these pins: Stance::pins

    const SurfaceBuffers* source = nullptr;  ///< what is pinned in this frame
    SurfaceBuffers surface;
    gl::Buffer list;  ///< pins, then the ring
    gl::Program program;
    struct {  ///< what `surface` was made from
        bool valid = false;
        std::vector<ActiveTarget> active;
        std::vector<glm::mat4> joints;
        EffectSettings settings;
        std::uint64_t number = 0;
    } made;

    std::size_t bytes() const;  ///< of its buffers
};

/// Finds where the pins of a character stand in this frame: its facts and its stance say so.
void find_pins(CharacterState& character);
/// Makes buffers and program where they are not there yet.
void prepare_pins(CharacterState& character);
/// Makes PinnedSurface::surface from its source.
void run_pins(CharacterState& character);

}  // namespace blush
