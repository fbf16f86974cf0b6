#include "tools/make_face/head_shape.h"

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

double carve(double a, double hollow, double k) { return -join(-a, hollow, k); }

double skull(const Vec3& p) {
    double d = ellipsoid(p, {0, 36, -8}, {74, 78, 88});
    d = join(d, ellipsoid(p, {0, 40, 34}, {57, 56, 56}), 22);            // frontal bone
    d = join(d, ellipsoid(p, {0, -20, 22}, {59, 60, 60}), 20);           // midface
    d = join(d, ellipsoid(p, {43, -22, 50}, {21, 15, 23}), 22);          // zygomatic bone
    d = join(d, cone(p, {36.5, -68, 8}, {9, -97.5, 66.5}, 12, 12), 22);  // body of the mandible
    d = join(d, cone(p, {46, -30, 0}, {36.5, -66, 8}, 12, 12), 20);      // its ramus
    d = join(d, ellipsoid(p, {0, -80, 30}, {42, 32, 46}), 20);           // floor of the mouth
    d = join(d, ellipsoid(p, {0, -97.5, 71}, {15.5, 13.5, 15.5}), 16);   // chin
    d = join(d, ellipsoid(p, {0, -50, -44}, {45, 46, 42}), 20);          // nape
    d = carve(d, ellipsoid(p, {79, -13, -10}, {11, 15, 11}), 7);         // behind the concha
    const Vec3 neck{p.x, p.y, p.z * 0.96};
    d = join(d, cone(p, {41, -62, -22}, {13, -170, 4}, 11, 5), 16);  // sternocleidomastoid
    return join(d, cone(neck, {0, -80, -24}, {0, -205, -36}, 44, 50), 22);
}

double soft_tissue(const Vec3& p, double d) {
    d = join(d, ellipsoid(p, {31, -48, 51}, {24.5, 28, 27}), 18);  // cheek
    d = join(d, ellipsoid(p, {0, -66, 60}, {32, 26, 32.5}), 14);   // over the dental arch
    d = join(d,
             join(cone(p, {0, 19, 84}, {23, 20.5, 80.5}, 7.5, 7.5), cone(p, {23, 20.5, 80.5}, {42, 17, 67}, 7.5, 7), 4),
             18);                                                      // brow
    d = carve(d, ellipsoid(p, {33.5, -2, 89.5}, {18, 12.5, 14}), 14);  // orbit
    d = join(d, cone(p, {14, -16, 76}, {44, -18, 62}, 7, 6), 10);      // infraorbital rim
    return d;
}

double lids(const Vec3& p, double d) {
    const double radius = landmark::eye_radius + landmark::lid_thickness;
    d = join(d, ellipsoid(p, landmark::eye_centre + Vec3(0, 5.5, -1.5), {17, 13, 15.5}), 5);  // fold over the upper lid
    const double softness = mix(5, 1.8, smooth_step(-5, 4, p.y));  // the upper lid has a crease, the lower one none
    d = join(d, glm::length(p - landmark::eye_centre) - radius, softness);
    d = join(d, glm::length(p - Vec3(17, -3, 75)) - 4, 5);  // inner canthus
    return d;
}

double nose(const Vec3& p, double d) {
    double n = cone(p, {0, 6, 85}, {0, -34, 100.5}, 4.8, 6.5);           // bridge
    n = join(n, cone(p, {2.5, -2, 79}, {8.5, -36, 90}, 6, 7.5), 9);      // its sides
    n = join(n, ellipsoid(p, {0, -36, 102.5}, {8.2, 8, 8.8}), 9);        // tip
    n = join(n, ellipsoid(p, {10.6, -40.5, 96}, {5.6, 6.2, 8.4}), 6.5);  // wing
    n = join(n, cone(p, {0, -42, 105}, {0, -47, 96}, 3.0, 3.4), 4);      // columella
    d = join(d, n, 7);
    return carve(d, ellipsoid(p, {6.2, -46.5, 98.5}, {3.1, 7.0, 5.2}), 2.5);
}

double mouth(const Vec3& p, double d) {
    // Vermilion of the upper lip: highest at the two peaks of the cupid's bow, 5 mm off the middle.
    double lips = join(cone(p, {0, -65.6, 92.5}, {6, -64.4, 91.8}, 4.3, 4.5),
                       cone(p, {6, -64.4, 91.8}, {25, -68.2, 80.5}, 4.5, 1.8), 2);
    const double lower = join(cone(p, {0, -73.6, 90.8}, {9, -73.2, 89.3}, 6.0, 5.6),
                              cone(p, {9, -73.2, 89.3}, {25, -69.4, 80.0}, 5.4, 1.4), 5);
    lips = join(lips, lower, 1.0);
    d = join(d, lips, 3.5);
    d = carve(d, cone(p, {0, -48, 101}, {0, -60, 99.6}, 2.6, 3.0), 4);  // philtrum
    d = carve(d, ellipsoid(p, {0, -86, 98}, {19, 5, 7.5}), 9);          // mentolabial fold
    d = carve(d, glm::length(p - Vec3(27.5, -69, 85)) - 2.5, 5);        // corner
    return d;
}

}  // namespace

double head_distance(const Vec3& point) {
    // The rounded |x| keeps features that lean toward the midline from creasing there.
    const Vec3 p{std::sqrt(square(point.x) + 1), point.y, point.z};
    return mouth(p, nose(p, lids(p, soft_tissue(p, skull(p)))));
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

double lip_line_y(double x) {
    const double t = std::clamp(std::abs(x) / landmark::mouth_corner_x, 0.0, 1.0);
    // The upper lip's tubercle dips in the middle, the line rises beside it and falls a little to the corner.
    return landmark::stomion_y - 0.9 * bell(t, 0.22) + 0.8 * std::sin(pi * t) - 0.3 * t;
}

}  // namespace blush::make_face
