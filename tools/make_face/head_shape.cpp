#include "tools/make_face/head_shape.h"

#include <span>

namespace blush::make_face {
namespace {

/// Quilez 2008, "Modeling with distance functions": first-order distance to an ellipsoid.
double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii) {
    const Vec3 q = (p - centre) / radii;
    const double k0 = glm::length(q);
    const double k1 = glm::length(q / radii);
    return k1 > 0 ? k0 * (k0 - 1) / k1 : -std::min({radii.x, radii.y, radii.z});
}

/// Segment a-b with a radius that goes from ra to rb.
double cone(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
    const Vec3 ab = b - a;
    const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
    return glm::length(p - a - ab * t) - mix(ra, rb, t);
}

/// Quadratic smooth minimum: both are rounded together within k of each other.
double join(double a, double b, double k) {
    const double h = std::max(k - std::abs(a - b), 0.0) / k;
    return std::min(a, b) - h * h * k / 4;
}

/// Catmull and Rom's cubic through the knots (x rising), y as at the ends beyond them.
double through(std::span<const Vec2> knots, double x) {
    if (x <= knots.front().x) return knots.front().y;
    if (x >= knots.back().x) return knots.back().y;
    std::size_t k = 0;
    while (x > knots[k + 1].x) ++k;
    const auto slope = [&](std::size_t n) {
        if (n == 0 || n + 1 == knots.size()) return 0.0;
        return (knots[n + 1].y - knots[n - 1].y) / (knots[n + 1].x - knots[n - 1].x);
    };
    const double span = knots[k + 1].x - knots[k].x, t = (x - knots[k].x) / span;
    const double a = slope(k) * span, b = slope(k + 1) * span, rise = knots[k + 1].y - knots[k].y;
    return knots[k].y + t * (a + t * (3 * rise - 2 * a - b + t * (a + b - 2 * rise)));
}

double carve(double a, double hollow, double k) { return -join(-a, hollow, k); }

double skull(const Vec3& p) {
    double d = ellipsoid(p, {0, 36, -8}, {74, 78, 88});
    d = join(d, ellipsoid(p, {0, 40, 34}, {57, 56, 56}), 22);             // frontal bone
    d = join(d, ellipsoid(p, {0, -20, 22}, {59, 60, 60}), 20);            // midface
    d = join(d, ellipsoid(p, {52, 2, 20}, {13.5, 28, 30}), 18);           // temple
    d = join(d, ellipsoid(p, {40.5, -21, 50}, {17.5, 13, 22.5}), 20);     // zygomatic bone
    d = join(d, cone(p, {38, -67, 8}, {9, -95, 65}, 12.5, 11.5), 20);     // body of the mandible
    d = join(d, cone(p, {46, -30, 0}, {38, -66, 8}, 12, 12), 20);         // its ramus
    d = join(d, ellipsoid(p, {0, -76, 30}, {41, 32, 46}), 20);            // floor of the mouth
    d = join(d, ellipsoid(p, {0, -95.5, 69.5}, {15.5, 12.5, 14.5}), 16);  // chin
    d = join(d, ellipsoid(p, {0, -46, -36}, {46, 44, 40}), 20);           // nape
    d = carve(d, ellipsoid(p, {77, -11, -5}, {14.5, 18, 14}), 7);         // behind the concha
    return d;
}

double neck_and_shoulders(const Vec3& p, double d) {
    // The neck leans forward going up, the shoulders fall by some 20 degrees.
    double n = cone(p, {0, -80, -17}, {0, -195, -58}, 43, 47);
    n = join(n, ellipsoid(p, {0, -128, 4}, {12, 20, 13}), 18);            // larynx
    n = join(n, cone(p, {24, -80, -48}, {58, -150, -76}, 16, 16), 34);    // trapezius, from the nape
    n = join(n, cone(p, {54, -152, -72}, {124, -176, -66}, 16, 20), 40);  // and along the shoulder
    double chest = ellipsoid(p, {0, -254, -58}, {132, 98, 76});
    chest = join(chest, ellipsoid(p, {110, -206, -62}, {34, 44, 42}), 40);     // deltoid
    chest = join(chest, cone(p, {15, -168, 0}, {66, -167, -21}, 4, 4.5), 20);  // clavicle, its inner half
    chest = join(chest, cone(p, {66, -167, -21}, {116, -164, -52}, 4.5, 7), 20);
    n = join(n, chest, 34);
    n = join(n, cone(p, {47, -48, -22}, {34, -108, -14}, 6, 6), 22);  // sternocleidomastoid
    n = join(n, cone(p, {34, -108, -14}, {13, -163, -2}, 6, 3.5), 28);
    n = carve(n, ellipsoid(p, {0, -162, 17}, {6, 7, 7}), 14);  // sternal notch
    return join(d, n, 18);
}

double soft_tissue(const Vec3& p, double d) {
    d = join(d, ellipsoid(p, {29.5, -47, 51}, {21.5, 28, 27.5}), 18);  // cheek
    d = join(d, ellipsoid(p, {0, -50, 72}, {27, 13, 19.5}), 9);        // maxilla, below the nose
    d = join(d, ellipsoid(p, {0, -66, 60}, {32, 26, 32.5}), 14);       // over the dental arch
    d = join(
        d,
        join(cone(p, {0, 18, 84.5}, {23, 18.5, 82.5}, 7.5, 7.5), cone(p, {23, 18.5, 82.5}, {44, 14, 67.5}, 7.5, 7), 4),
        18);                                                                 // brow
    d = carve(d, ellipsoid(p, {33.5, -2.5, 89.5}, {17.5, 11.5, 12.5}), 14);  // orbit
    d = join(d, ellipsoid(p, {19, 9, 72}, {10, 8, 13}), 8);                  // between brow and inner canthus
    d = join(d, cone(p, {14, -16, 76}, {44, -18, 62}, 7, 6), 10);            // infraorbital rim
    return d;
}

double lids(const Vec3& p, double d) {
    const double radius = landmark::eye_radius + landmark::lid_thickness;
    d = join(d, ellipsoid(p, landmark::eye_centre + Vec3(0, 5.5, -1.5), {17, 13, 15.5}), 5);  // fold over the upper lid
    const double softness = mix(5, 1.8, smooth_step(-5, 4, p.y));  // the upper lid has a crease, the lower one none
    d = join(d, glm::length(p - landmark::eye_centre) - radius, softness);
    d = join(d, glm::length(p - Vec3(17, -3, 75)) - 4, 5);  // inner canthus
    // The crease that the upper lid folds at runs evenly over its edge.
    const double x = std::abs(p.x), over = p.y - canthal_y(x) - 0.95 * upper_lid_height(x) - 4.4;
    const double ends = smooth_step(18.5, 24, x) * smooth_step(48, 42, x) * smooth_step(66, 72, p.z);
    return d + 1.1 * bell(over, 1.0) * ends;
}

double nose(const Vec3& p, double d) {
    double n = cone(p, {0, 5, 85.2}, {0, -28, 99.4}, 5.6, 7.4);              // bridge
    n = join(n, cone(p, {3, -2, 78}, {8.5, -33, 87.5}, 6.5, 8.5), 10);       // its sides
    n = join(n, ellipsoid(p, {0, -34.0, 101.2}, {8.4, 7.2, 9.6}), 7);        // tip
    n = join(n, ellipsoid(p, {4.0, -36.4, 103.2}, {5.0, 4.8, 5.6}), 6);      // its two domes
    n = join(n, ellipsoid(p, {0, -37, 90}, {10, 9, 13}), 5);                 // no void between nose and face
    n = join(n, ellipsoid(p, {11.0, -39.6, 92.6}, {5.9, 6.5, 9.2}), 6);      // wing
    n = join(n, cone(p, {0, -38.6, 105.0}, {0, -44.6, 96.4}, 3.0, 3.6), 5);  // columella
    d = join(d, n, 7);
    // The groove over the wing, from its rim in front to where it meets the cheek.
    const double groove = join(cone(p, {13.6, -33.4, 98.5}, {17.4, -34.6, 92}, 0.2, 0.7),
                               cone(p, {17.4, -34.6, 92}, {18.6, -42, 87}, 0.7, 0.9), 2);
    return carve(d, groove, 2.8);
}

double mouth(const Vec3& p, double d) {
    // A relief over the dental arch, in millimetres outward: profiles across the lips by the share of the red's height.
    const double fade = smooth_step(62, 72, p.z);
    if (fade == 0 || p.y > -46 || p.y < -112) return d;
    const double x = std::abs(p.x), t = std::min(x / landmark::mouth_corner_x, 1.0);
    const double above = p.y - lip_line_y(x);
    const double full = std::pow(std::max(0.0, 1 - t * t), 0.8);
    static constexpr Vec2 upper[] = {{0, -1.3}, {0.2, 1.0}, {0.5, 2.6}, {0.8, 3.3}, {1.0, 3.3}};
    static constexpr Vec2 lower[] = {{0, -1.3}, {0.18, 1.4}, {0.42, 2.6}, {0.7, 2.0}, {1.0, 0.2}};
    const auto at = [&](double across, double upward, double wide, double high) {
        return bell(x - across, wide) * bell(p.y - upward, high);
    };
    double h = 0;
    if (above >= 0) {
        const double red = std::max(upper_lip_height(x), 1.5);
        h = through(upper, above / red) * smooth_step(11, 0, above - red) * full;
        h += 0.9 * bell(x, 4) * bell(above - 2, 2.2);  // tubercle
    } else {
        const double red = std::max(lower_lip_height(x), 1.5);
        h = through(lower, -above / red) * smooth_step(4, 0, -above - red) * full;
        h += 0.5 * bell(x - 8, 5) * bell(above + 4, 3);  // the lower lip's two lobes
    }
    h -= 2.6 * at(0, -83, 17, 5.2);                                    // mentolabial fold
    h += 0.8 * at(5.2, -56, 2.3, 6.5) - 0.9 * at(0, -55.5, 2.6, 6.0);  // columns of the philtrum
    h -= 1.6 * at(28, -67.5, 4, 5);                                    // corner
    return d - h * fade;
}

}  // namespace

double head_distance(const Vec3& point) {
    // The rounded |x| keeps features that lean toward the midline from creasing there.
    const Vec3 p{std::sqrt(square(point.x) + 1), point.y, point.z};
    return mouth(p, nose(p, lids(p, soft_tissue(p, neck_and_shoulders(p, skull(p))))));
}

Vec3 head_normal(const Vec3& p) {
    // Central differences along the four diagonals of a cube: four samples instead of six.
    constexpr double h = 0.02;
    constexpr Vec3 corners[] = {{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}};
    Vec3 sum(0);
    for (const Vec3& corner : corners) sum += corner * head_distance(p + corner * h);
    return glm::normalize(sum);
}

Vec3 leave_head(const Vec3& origin, const Vec3& direction) {
    double low = 0;
    constexpr double farthest = 400, least_step = 0.25;
    while (low < farthest) {
        const double d = head_distance(origin + direction * low);
        if (d >= 0) break;
        low += std::max(-0.6 * d, least_step);
    }
    double high = low;
    low = std::max(0.0, low - 12);
    while (low < high && head_distance(origin + direction * low) >= 0) low -= 6;
    for (int i = 0; i < 30; ++i) {
        const double middle = (low + high) / 2;
        (head_distance(origin + direction * middle) < 0 ? low : high) = middle;
    }
    return origin + direction * high;
}

namespace {
/// An almond under the wing, its long way from the tip back and aside.
constexpr Vec3 nostril_centre{6.9, -45.2, 96.6}, nostril_inward{0.6, 8.0, -1.5};
constexpr double nostril_half_length = 6.3, nostril_half_width = 2.9, nostril_height = 4.5;

/// 0 in the almond's middle, 1 on its rim.
double nostril_reach(const Vec3& half) {
    const Vec3 along = glm::normalize(Vec3(0.36, -0.22, -0.9)), up = glm::normalize(nostril_inward);
    const Vec3 across = glm::normalize(glm::cross(along, up));
    const Vec3 arm = half - nostril_centre;
    return glm::length(Vec3(glm::dot(arm, along) / nostril_half_length, glm::dot(arm, across) / nostril_half_width,
                            glm::dot(arm, up) / nostril_height));
}
}  // namespace

Vec3 sink_nostril(const Vec3& p) {
    const Vec3 sunk = nostril_inward * smooth_step(1.05, 0.6, nostril_reach({std::abs(p.x), p.y, p.z}));
    return p + Vec3(p.x < 0 ? -sunk.x : sunk.x, sunk.y, sunk.z);
}

double nostril_depth(const Vec3& p) {
    // What was sunk by a share of the way came from where that share takes it back to.
    const Vec3 half{std::abs(p.x), p.y, p.z};
    double share = 0;
    for (int n = 1; n <= 10; ++n) {
        const double way = 0.1 * n;
        if (smooth_step(1.05, 0.6, nostril_reach(half - nostril_inward * way)) >= way) share = way;
    }
    return share;
}

Vec3 project_to_head(const Vec3& start) {
    Vec3 p = start;
    for (int i = 0; i < 2; ++i) p -= head_normal(p) * std::clamp(head_distance(p), -3.0, 3.0);
    return p;
}

double canthal_y(double x) {
    const double t = (x - landmark::inner_canthus.x) / (landmark::outer_canthus.x - landmark::inner_canthus.x);
    return mix(landmark::inner_canthus.y, landmark::outer_canthus.y, t);
}

namespace {
double along_eye(double x) {
    return std::clamp((x - landmark::inner_canthus.x) / (landmark::outer_canthus.x - landmark::inner_canthus.x), 0.0,
                      1.0);
}
}  // namespace

double upper_lid_height(double x) {
    // An almond: the upper lid peaks inside the middle, the lower one outside it.
    const double t = along_eye(x);
    return 5.1 * std::pow(std::sin(pi * std::pow(t, 0.92)), 0.72);
}

double lower_lid_height(double x) {
    const double t = along_eye(x);
    return 5.0 * std::pow(std::sin(pi * std::pow(t, 1.12)), 0.85);
}

double upper_lip_height(double x) {
    const double t = std::min(std::abs(x) / landmark::mouth_corner_x, 1.0);
    return 7.4 * std::pow(1 - t * t, 0.85) - 1.5 * bell(x, 3);
}

double lower_lip_height(double x) {
    const double t = std::min(std::abs(x) / landmark::mouth_corner_x, 1.0);
    return 9.0 * std::pow(1 - t * t, 0.77);
}

double lip_line_y(double x) {
    const double t = std::clamp(std::abs(x) / landmark::mouth_corner_x, 0.0, 1.0);
    // The upper lip's tubercle dips in the middle, the line rises beside it and falls a little to the corner.
    return landmark::stomion_y - 0.9 * bell(t, 0.22) + 0.4 * std::sin(pi * t) + 1.6 * t * t;
}

}  // namespace blush::make_face
