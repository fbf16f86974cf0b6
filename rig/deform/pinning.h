#pragma once
/// Pinning: some vertices of a surface are where somebody else says, and what lies around them follows, so that
/// nothing tears.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rig/face.h"
#include "rig/vectors.h"

namespace blush {

inline constexpr std::uint32_t no_vertex = 0xffffffff;
/// Pins that a vertex follows, at most.
inline constexpr std::size_t pins_a_vertex = 4;

/// A vertex that pins move. Of 32-bit values alone: a shader reads it as it is.
struct PinnedVertex {
    std::uint32_t vertex = 0;
    float influence = 0;                             ///< 1 at a pin, to 0 at the width
    std::array<std::uint32_t, pins_a_vertex> pin{};  ///< numbers of pins
    std::array<float, pins_a_vertex> weight{};       ///< of sum 1; a pin's own vertex and its copies: 1, 0, 0, 0
};

/// Where a pin is, in the space of the surface's buffers.
struct Pin {
    Vec3 position{0};
    std::uint32_t vertex = no_vertex;  ///< whose own position and normal it takes the place of; none: it does not act
    Vec3 normal{0, 0, 1};              ///< unit length
    std::uint32_t unused = 0;

    bool operator==(const Pin&) const = default;
};

/// Everything that pins at `vertices` move, ascending: each vertex nearer than `width` to one of them at rest, along
/// the edges of its mesh. It follows the four nearest pins of its mesh, the nearer the more (Franke and Nielson 1980:
/// no jump where another one becomes one of the four), less from the pins to the width by a cubic with flat ends. A
/// vertex at a pin's place goes with it whole. places: rest_places(); width: in their units, 0 or more.
std::vector<PinnedVertex> pin_ring(const Face& face, std::span<const DVec3> places,
                                   std::span<const std::uint32_t> vertices, double width);

/// Moves the ring from where the surface itself is to where the pins are. from: as deformed; to: a copy of it at first.
/// A vertex at a pin gets its position and normal to the bit; others are moved by influence times the weighted mean of
/// what the pins moved, positions and normals alike. Twin of shaders/deform/pin.comp.
struct PinnedAttributes {
    std::span<const Vec3> from_positions, from_normals;
    std::span<Vec3> positions, normals;
    std::span<Vec4> tangents;
};
void apply_pins(std::span<const PinnedVertex> ring, std::span<const Pin> pins, const PinnedAttributes& surface);

}  // namespace blush
