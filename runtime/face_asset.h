#pragma once
/// FaceAsset: a face with its rig and its maps, loaded once, for any number of characters on any number of devices.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "rig/controls/rig.h"
#include "rig/controls/rig_description.h"
#include "rig/face.h"
#include "rig/light/occlusion.h"
#include "rig/result.h"
#include "runtime/camera.h"
#include "runtime/files/face_appearance.h"
#include "runtime/surface_point.h"

namespace blush {

struct AssetState;

/// A handle to data that never changes: copies share it, and any thread may read it. Needs no GL.
class FaceAsset {
public:
    /// Loads a face file (runtime/files/face_file.h) with what stands beside it: rig description, maps of wrinkles and
    /// blood, occlusion. Error: a sentence with file, place and reason.
    static Result<FaceAsset> load(const std::filesystem::path& path);
    /// The same from memory. `face` must satisfy validate() and `description` check(); without one, that of its target
    /// names. `occlusion` has one transfer a vertex of this face in each pose.
    static Result<FaceAsset> create(Face face, const std::optional<RigDescription>& description = std::nullopt,
                                    FaceAppearance appearance = {},
                                    std::optional<OcclusionSet> occlusion = std::nullopt);

    /// The same face with other maps.
    FaceAsset with_appearance(FaceAppearance appearance) const;
    FaceAsset with_occlusion(std::optional<OcclusionSet> occlusion) const;

    /// The face as it is drawn: meshes whose vertices the file has far out stand near the origin, in nodes that bring
    /// them there (rig/far_vertices.h); all else as the file says.
    const Face& face() const;
    const Rig& rig() const;
    const FaceAppearance& appearance() const;

    /// A camera that frames the head at rest, and of a bust what lies close to it, where the face stands in its file.
    /// aspect: width / height.
    OrbitCamera framing(float aspect) const;

    /// A point of the surface, for Character::at() of any character of this asset. Error: the triangle does not exist
    /// or no node draws it, or barycentrics that are not finite or add up to zero.
    Result<SurfacePoint> attach(const SurfacePlace& place) const;
    /// The place at rest that is nearest to a point in the file's space. Looks at every triangle. Nothing: the face
    /// draws none, or the point is not finite.
    std::optional<SurfacePlace> nearest_place(const DVec3& point_face) const;

    /// The edge where the neck ends: one vertex for each place on it, in order around it. Of the open borders of its
    /// skin (of all, where nothing is skin) that come down to the lowest tenth of its height at rest and are at least
    /// half as long as the longest of those, the lowest. Empty: it is closed below.
    std::vector<std::uint32_t> neck_border() const;

    /// The distance between neighbouring floats where the file puts its farthest vertex, in millimetres: how exactly
    /// the file can say where anything is. Vertices far out are drawn relative to the middle of their mesh, so that
    /// this is all that is lost there.
    double float_step_mm() const;

    const AssetState& state() const { return *state_; }

private:
    explicit FaceAsset(std::shared_ptr<const AssetState> state);
    std::shared_ptr<const AssetState> state_;
};

}  // namespace blush
