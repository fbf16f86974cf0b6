#pragma once
/// Where a face's eyes are, and which vertices are the edges of their lids: found once, from the face at rest.

#include <array>
#include <optional>
#include <vector>

#include "rig/face.h"
#include "rig/head/material_kind.h"

namespace blush {

/// One eyeball of a face that looks along +Z, in the units of its mesh.
struct Eyeball {
    std::size_t node = 0;  ///< that draws it
    Vec3 centre{0};
    float radius = 0;
    std::uint32_t pole = 0;  ///< its vertex farthest to the front
};

inline constexpr std::size_t lid_point_count = 12;  // BLUSH_LID_POINTS
struct LidEdges {
    std::array<std::uint32_t, lid_point_count> upper{}, lower{};  ///< vertices, from the one corner to the other
};

struct EyeSockets {
    std::vector<Eyeball> eyes;   ///< none, or two: with the smaller x first (the same one twice where there is one)
    std::vector<LidEdges> lids;  ///< one an eye, or none: where the skin around an eye leaves gaps
    std::size_t lid_node = 0;    ///< that draws the lids
};

/// Eyeballs are the primitives of MaterialKind::eye. A lid's edge is, for each direction around the eye's axis, the
/// skin nearest to that axis.
EyeSockets find_eye_sockets(const Face& face, const std::vector<MaterialKind>& kinds);

}  // namespace blush
