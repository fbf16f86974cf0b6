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
    d = join(d, ellipsoid(p, {0, 40, 34}, {57, 56, 56}), 22);           // frontal bone
    d = join(d, ellipsoid(p, {0, -20, 22}, {59, 60, 60}), 20);          // midface
    d = join(d, ellipsoid(p, {43, -22, 50}, {21, 15, 23}), 22);         // zygomatic bone
    d = join(d, cone(p, {36.5, -68, 8}, {9, -97.5, 65}, 12, 12), 22);   // body of the mandible
    d = join(d, cone(p, {46, -30, 0}, {36.5, -66, 8}, 12, 12), 20);     // its ramus
    d = join(d, ellipsoid(p, {0, -80, 30}, {42, 32, 46}), 20);          // floor of the mouth
    d = join(d, ellipsoid(p, {0, -97.5, 69}, {15.5, 13.5, 15.0}), 16);  // chin
    d = join(d, ellipsoid(p, {0, -50, -44}, {45, 46, 42}), 20);         // nape
    d = carve(d, ellipsoid(p, {79, -13, -10}, {11, 15, 11}), 7);        // behind the concha
    return d;
}

double neck_and_shoulders(const Vec3& p, double d) {
    double n = cone({p.x, p.y, p.z * 0.96}, {0, -80, -24}, {0, -205, -38}, 45, 50);
    n = join(n, ellipsoid(p, {0, -142, 10}, {12, 20, 14}), 16);          // larynx
    n = join(n, cone(p, {24, -96, -62}, {142, -212, -50}, 22, 20), 46);  // trapezius
    double chest = join(ellipsoid(p, {0, -296, -34}, {165, 112, 80}), ellipsoid(p, {118, -262, -44}, {70, 62, 52}), 30);
    chest = join(chest, ellipsoid(p, {62, -236, -38}, {78, 52, 46}), 30);  // what fills the shoulder
    const double clavicle =
        join(cone(p, {18, -206, 33}, {70, -199, 26}, 4.5, 5), cone(p, {70, -199, 26}, {150, -192, -22}, 5, 7), 10);
    chest = join(chest, clavicle, 9);
    n = join(n, chest, 26);
    n = join(n, cone(p, {50, -48, -22}, {34, -120, -8}, 8, 8), 14);  // sternocleidomastoid
    n = join(n, cone(p, {34, -120, -8}, {15, -196, 13}, 8, 5), 24);
    n = carve(n, ellipsoid(p, {0, -199, 40}, {9, 9, 11}), 12);    // sternal notch
    n = carve(n, ellipsoid(p, {52, -186, 22}, {26, 8, 18}), 16);  // over the clavicle
    return join(d, n, 20);
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
    // The crease that the upper lid folds at, some 8 mm over its edge.
    const double crease = join(cone(p, {20.5, 3.6, 78.2}, {31, 8.4, 82.3}, 0.5, 1.1),
                               cone(p, {31, 8.4, 82.3}, {47, 3.2, 75.6}, 1.1, 0.6), 3);
    d = carve(d, crease, 1.8);
    return d;
}

double nose(const Vec3& p, double d) {
    double n = cone(p, {0, 6, 85}, {0, -33, 101}, 4.6, 5.4);               // bridge
    n = join(n, cone(p, {2.5, -2, 79}, {7.5, -35, 90.5}, 6, 6.6), 9);      // its sides
    n = join(n, ellipsoid(p, {0, -36, 102.5}, {6.6, 7.2, 8.2}), 7);        // tip
    n = join(n, ellipsoid(p, {0, -37, 87}, {8, 9, 13}), 4);                // no void between nose and face
    n = join(n, ellipsoid(p, {3.4, -37, 105}, {4.2, 4.8, 5.0}), 4);        // its two domes
    n = join(n, ellipsoid(p, {11.4, -41.2, 94.2}, {5.0, 6.2, 7.8}), 4.5);  // wing
    n = join(n, cone(p, {0, -42, 105.5}, {0, -47.5, 96}, 2.6, 3.0), 3.5);  // columella
    d = join(d, n, 5.5);
    d = carve(d, cone(p, {16.2, -36, 90}, {17.2, -45, 88.5}, 0.7, 1.0), 3);  // groove behind the wing
    return d;
}

double mouth(const Vec3& p, double d) {
    // Vermilion of the upper lip: highest at the two peaks of the cupid's bow, 5 mm off the middle.
    double lips = join(cone(p, {0, -66.0, 92.6}, {5.5, -65.2, 92.2}, 3.0, 3.2),
                       cone(p, {5.5, -65.2, 92.2}, {25, -68.6, 80.2}, 3.2, 1.0), 2);
    const double lower = join(cone(p, {0, -72.6, 91.0}, {9, -72.2, 89.4}, 4.5, 4.2),
                              cone(p, {9, -72.2, 89.4}, {25, -69.3, 79.8}, 4.1, 0.9), 5);
    lips = join(lips, lower, 0.9);
    d = join(d, lips, 2.4);
    d = carve(d, cone(p, {0, -50, 99.4}, {0, -61, 98.4}, 2.2, 2.9), 2.6);  // philtrum
    d = carve(d, ellipsoid(p, {0, -84.5, 97}, {18, 4.6, 7.5}), 9);         // mentolabial fold
    d = carve(d, glm::length(p - Vec3(27.5, -69, 85)) - 2.5, 5);           // corner
    return d;
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

Vec3 sink_nostril(const Vec3& p) {
    constexpr Vec3 centre{6.2, -46.8, 97.6}, widths{2.9, 4.0, 4.3}, inward{1.2, 8.0, -3.0};
    const double reach = glm::length((Vec3(std::abs(p.x), p.y, p.z) - centre) / widths);
    const Vec3 sunk = inward * smooth_step(1.15, 0.35, reach);
    return p + Vec3(p.x < 0 ? -sunk.x : sunk.x, sunk.y, sunk.z);
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
    return landmark::stomion_y - 0.9 * bell(t, 0.22) + 0.6 * std::sin(pi * t) + 0.5 * t;
}

}  // namespace blush::make_face
