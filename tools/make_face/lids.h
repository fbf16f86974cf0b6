#pragma once
/// How the lids of the left eye move: they turn about the horizontal axis through the eye's centre and so slide over
/// the eyeball; the skin follows less and less toward the brow and the cheek.

#include "tools/make_face/head_mesh.h"

namespace blush::make_face {

struct LidMove {
    double close = 0;          ///< 1: the edges meet, most of the way done by the upper lid
    double upper_degrees = 0;  ///< further turn of the upper lid, positive up
    double lower_degrees = 0;  ///< of the lower lid, positive up
    double sideways_mm = 0;    ///< of the edges, positive to the face's left
    double yaw_degrees = 0;    ///< turn about the vertical axis with the ball that drags the lids, positive to the left
};

class Lids {
public:
    explicit Lids(const Head& head);

    /// Where vertex v goes, relative to rest; zero away from the left eye.
    Vec3 move(Index v, const LidMove& lid_move) const;

    /// Lengthens deltas outward wherever a vertex would enter an eyeball at any weight between 0 and 1.
    void keep_off_eyes(std::vector<Vec3>& deltas) const;

    /// For a closed left eye: where the push outward has parted the edges, both take the outer one's place.
    void join_edges(std::vector<Vec3>& deltas) const;

    /// Where p goes when it is carried by a lid whose edge goes from `edge` by `delta`: turned with it about the eye.
    Vec3 carried(const Vec3& edge, const Vec3& delta, const Vec3& p) const;

private:
    struct Opening {
        double upper, lower;  ///< angles of the edges over the horizon through the eye's centre, radians
    };
    Opening opening_at(double x) const;

    const Head& head_;
};

}  // namespace blush::make_face
