#pragma once
/// One frame for all faces: where a point of any face lies on the mean face, so that what is known of faces (where
/// blood goes in anger) can be written down once, and a map can be carried from one face to another
/// (jimenez-2012, 7.4.2).
///
/// Canonical coordinates are millimetres on the mean face: y up from the line of the pupils, x around the head from its
/// midline, as an arc on a cylinder about the head's upright axis; +x is the face's own left. So cheeks and ears do not
/// fall on one another as they do seen from the front. Pupils: (+-31, 0); mouth: (0, -68); chin about -108, hairline
/// about 65, ears at about +-135, the back of the head beyond +-200. Proportions: Farkas 1994.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rig/face.h"
#include "rig/map.h"
#include "rig/vectors.h"

namespace blush {

/// Half the distance between the pupils of the mean face, the height of its mouth below them, and how far the axis of
/// the head lies behind the eyes: the ear canal's place (Farkas 1994: pupils 62 mm apart, mouth 68 mm below them, the
/// tragion 85 mm behind the exocanthion in depth).
inline constexpr float canonical_pupil_mm = 31, canonical_mouth_mm = -68, canonical_axis_depth_mm = 85;

/// Three places that fix a face's frame, in mesh units, and their heights on the mean face.
struct FaceLandmarks {
    Vec3 left_eye{0}, right_eye{0}, mouth{0};
    float eye_height_mm = 0, mouth_height_mm = canonical_mouth_mm;
};

/// The primitives that carry facial skin: those of one material that the eyelids' targets and the mouth's both move.
/// Indices into Face::primitives; empty where the targets do not say.
std::vector<std::uint32_t> skin_primitives(const Face& face);

/// Landmarks from what the face's targets move: the lids close over the eyes, smiles pull at the mouth. Nothing where
/// the targets are missing or their places coincide.
std::optional<FaceLandmarks> landmarks_from_targets(const Face& face, std::span<const std::uint32_t> primitives);

/// Canonical coordinates of points of one face.
class CanonicalFrame {
public:
    /// The three landmarks must not lie on one line; usable() says so.
    explicit CanonicalFrame(const FaceLandmarks& landmarks);
    bool usable() const { return usable_; }
    Vec2 canonical_mm(const Vec3& position) const;
    /// From the upright axis of the head.
    float radius_mm(const Vec3& position) const;
    /// The length around the head after which x comes back: a full turn.
    static float turn_mm();

private:
    Vec3 between_eyes_{0}, left_{1, 0, 0}, up_{0, 1, 0}, forward_{0, 0, 1};
    float mm_across_ = 1, mm_up_ = 1, eye_height_mm_ = 0;
    bool usable_ = false;
};

/// Canonical coordinates of every texel of a face's texture.
struct CanonicalMap {
    Map<Vec2> canonical_mm;  ///< texels outside every triangle have those of the nearest one inside
    ScalarMap coverage;      ///< 1 where a triangle covers the texel's centre, else 0
};

/// From the geometry: the triangles of these primitives in their own texture layout (uv0; rig/wrinkles/uv_raster.h says
/// how repeats and overlaps count). Nothing where no texel is covered.
std::optional<CanonicalMap> canonical_map(const Face& face, std::span<const std::uint32_t> primitives,
                                          const CanonicalFrame& frame, std::uint32_t width, std::uint32_t height);

/// From the texture alone: where pupils and mouth lie in it (texture coordinates, v down), for layouts that unroll the
/// face. Every texel counts as covered. Nothing where the places lie on one line.
struct TextureLandmarks {
    Vec2 left_eye{0}, right_eye{0}, mouth{0};
};
std::optional<CanonicalMap> canonical_map(const TextureLandmarks& landmarks, std::uint32_t width, std::uint32_t height);

/// 1 where a texel shows the face proper, from the brows to the chin and to before the ears, else 0: the skin that a
/// face's colour is judged by, without scalp, body and gums.
ScalarMap face_region(const CanonicalMap& map);

/// A map of one face in the layout of another: every texel of `to` takes the value that `from` has at the same place of
/// the mean face, by a grid of 2 mm. `values` is of `from`'s size; the result of `to`'s.
ScalarMap carried(const ScalarMap& values, const CanonicalMap& from, const CanonicalMap& to);

}  // namespace blush
