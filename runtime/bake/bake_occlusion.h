#pragma once
/// Ray casts how a face hides light from its own vertices (chappuis-2011, 3.3, which draws cube maps instead), with
/// Intel's Embree. No GL.

#include <string>
#include <vector>

#include "rig/light/occlusion.h"
#include "rig/result.h"

namespace blush {

struct OcclusionBake {
    std::uint32_t rays = 256;          ///< a vertex, 16 to 65,536
    std::vector<std::string> targets;  ///< that are at weight 1 in a pose of their own; names of the face
};

/// The targets that open and close what hides light, as far as a face has them: the jaw, the lids.
std::vector<std::string> usual_occlusion_targets(const Face& face);

/// Of the face in the world, at rest and in each pose. Everything opaque hides light, from both sides. The same input
/// gives the same bytes. Error: no such target; too many poses; Embree does not start.
Result<OcclusionSet> bake_occlusion(const Face& face, const OcclusionBake& options);

}  // namespace blush
