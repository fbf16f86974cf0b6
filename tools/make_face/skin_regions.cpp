#include "tools/make_face/skin_regions.h"

#include "tools/make_face/head_shape.h"

namespace blush::make_face {
namespace {

using namespace landmark;

/// Millimetres inside the red lip's outline as seen from the front; negative outside.
double inside_lip(const Vec3& p) {
    const double x = std::abs(p.x);
    const double ragged = 0.22 * noise(p / 0.8) + 0.35 * noise(p / 3.1);
    const double top = lip_line_y(x) + upper_lip_height(x);
    const double bottom = lip_line_y(x) - lower_lip_height(x);
    const double beside = mouth_corner_x + 0.3 - x;
    return std::min({top - p.y, p.y - bottom, beside}) + ragged;
}

double lid_edge_distance(const Vec3& p, bool upper) {
    const double x = std::abs(p.x), height = p.y - canthal_y(x);
    return upper ? height - upper_lid_height(x) : -height - lower_lid_height(x);
}

bool before_mouth(const Vec3& p) { return p.z > 60 && p.y < -50 && p.y > -90; }

}  // namespace

double lip_cover(const Vec3& p) { return before_mouth(p) ? smooth_step(-1.1, 1.2, inside_lip(p)) : 0; }

double lip_border(const Vec3& p) {
    return before_mouth(p) ? bell(inside_lip(p) + 1.5, 1.1) * smooth_step(mouth_corner_x + 2, 16, std::abs(p.x)) : 0;
}

double lip_seam(const Vec3& p) {
    if (!before_mouth(p)) return 0;
    return bell(p.y - lip_line_y(p.x), 1.0) * smooth_step(mouth_corner_x + 1.5, mouth_corner_x - 1.5, std::abs(p.x));
}

double lid_rim(const Vec3& p, bool upper) {
    const double x = std::abs(p.x);
    if (p.z < 50 || x < inner_canthus.x - 1 || x > outer_canthus.x + 3) return 0;
    if (upper ? p.y < canthal_y(x) - 0.3 : p.y > canthal_y(x) + 0.3) return 0;
    const double t = (x - inner_canthus.x) / (outer_canthus.x - inner_canthus.x);
    return smooth_step(-0.02, 0.15, t) * smooth_step(1.08, 0.95, t) *
           bell(lid_edge_distance(p, upper), upper ? 1.0 : 0.8);
}

double around_eye(const Vec3& half) { return bell(half, eye_centre + Vec3(0, 0, 10), {20, 13, 18}); }

double nostril(const SurfaceTexel& texel) { return smooth_step(0.05, 0.6, nostril_depth(texel.half())); }

double oily(const Vec3& half) {
    return std::max({bell(half, {0, -25, 104}, {14, 26, 24}), bell(half, {0, 42, 90}, {36, 20, 26}),
                     0.7 * bell(half, {0, -98, 88}, {16, 12, 18})});
}

double temple(const Vec3& half) { return bell(half, {58, 2, 46}, {16, 26, 30}); }

double wide_pored(const Vec3& half) {
    return std::max(bell(half, {0, -34, 104}, {17, 20, 26}), 0.8 * bell(half, {27, -34, 78}, {17, 17, 22}));
}

}  // namespace blush::make_face
