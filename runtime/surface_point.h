#pragma once
/// Points of a face's surface that things are fixed to: a tear, a piercing, the end of a strand.

#include <cstdint>
#include <memory>

#include "rig/vectors.h"

namespace blush {

struct AttachedPoint;

/// A place on a face's surface, wherever that goes.
struct SurfacePlace {
    std::uint32_t triangle = 0;  ///< its corners are Face::indices[3 * triangle] and the two after it
    /// Weights of the corners, in that order; divided by their sum. A negative one: beside the triangle, in its plane.
    Vec3 barycentrics{1.0F / 3};
};

/// A place together with what its corners need of the face. Of an asset, and good for any character that shows it; one
/// thread at a time asks for it.
class SurfacePoint {
public:
    explicit SurfacePoint(std::unique_ptr<AttachedPoint> made);
    SurfacePoint(SurfacePoint&&) noexcept;
    SurfacePoint& operator=(SurfacePoint&&) noexcept;
    ~SurfacePoint();

    const SurfacePlace& place() const;

    AttachedPoint* attached() const { return attached_.get(); }

private:
    std::unique_ptr<AttachedPoint> attached_;
};

/// The surface at a point, in the world.
struct SurfaceFrame {
    DVec3 position_world{0};
    Vec3 normal_world{0, 0, 1};      ///< unit length
    Vec4 tangent_world{1, 0, 0, 1};  ///< xyz: unit length, perpendicular to the normal; bitangent = cross(n, t.xyz) * w

    /// x along the tangent, y along the bitangent, z along the normal; rigid, or mirrored where w is -1.
    DMat4 world_from_point() const;
};

}  // namespace blush
