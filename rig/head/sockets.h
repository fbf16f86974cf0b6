#pragma once
/// Where things hang on a head: glasses on the head, a moustache's lower half on the jaw, a lens on an eye.

#include <array>
#include <cstdint>
#include <vector>

#include "rig/controls/head_and_eyes.h"
#include "rig/face.h"
#include "rig/head/eye_sockets.h"
#include "rig/head/material_kind.h"
#include "rig/vectors.h"

namespace blush {

/// Left and right are the face's own: left is +X.
enum class Socket : std::uint8_t { head, jaw, left_eye, right_eye };
inline constexpr std::size_t socket_count = 4;

/// What a socket moves with.
struct SocketSource {
    enum class Kind : std::uint8_t {
        none,
        node,     ///< as rigidly as `node` moves from where it is at rest
        surface,  ///< as rigidly as the surface at `vertices` moves: fit_rigid()
    };
    Kind kind = Kind::none;
    std::int32_t node = -1;
    std::int32_t joint = -1;  ///< number of that node among the joints of all skins; -1: it is none
    std::vector<std::uint32_t> vertices;
    std::vector<double> weights;  ///< one for each of `vertices`
    DVec3 origin_face{0};         ///< of a node's socket at rest, in the file's space; a surface's is its middle
};

/// Head: a joint named head that vertices follow, at the joint's origin; else HeadAndEyes::head.
/// Eyes: HeadAndEyes' nodes, at the points that they turn about; else joints named so; else the surface of the eyeball,
/// about its middle.
/// Jaw: a joint named jaw that vertices follow, at the joint's origin; else, where a target opens the jaw ("jawOpen" in
/// any spelling), the skin that it moves at least 0.7 times as far as its farthest vertex: the chin, which moves as the
/// bone does; else a node named jaw that something hangs on.
std::array<SocketSource, socket_count> find_sockets(const Face& face, const HeadAndEyes& head_and_eyes,
                                                    const EyeSockets& eyes, const std::vector<MaterialKind>& kinds);

}  // namespace blush
