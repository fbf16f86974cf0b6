#pragma once
/// What a SurfacePoint holds.

#include <array>
#include <memory>

#include "rig/deform/face_part.h"
#include "runtime/surface_point.h"

namespace blush {

struct AttachedPoint {
    AttachedPoint(const Face& face, SurfacePlace at, const std::array<std::uint32_t, 3>& corners,
                  std::shared_ptr<const char> of_geometry)
        : place(at), geometry(std::move(of_geometry)), part(face, corners, FacePart::Wanted::directions) {}

    SurfacePlace place;
    DVec3 barycentrics{0};                 ///< of sum 1
    std::shared_ptr<const char> geometry;  ///< AssetState::geometry
    std::size_t entry = 0;                 ///< of Stance::world_from_node
    FacePart part;
};

}  // namespace blush
