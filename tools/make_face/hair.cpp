#include "tools/make_face/hair.h"

#include "tools/make_face/head_shape.h"

namespace blush::make_face {
namespace {

/// Height of the hairline at an azimuth in degrees (0 in front, 90 at the ear, 180 behind), millimetres: trichion,
/// temple, sideburn, over the ear, nape.
double hairline(double azimuth_degrees) {
    struct Knot {
        double azimuth, y;
    };
    constexpr Knot knots[] = {{0, 69},   {14, 70},   {27, 66},   {38, 56},   {48, 48},  {58, 40},
                              {66, 26},  {72, 0},    {77, -18},  {86, -16},  {90, 10},  {96, 22},
                              {106, 16}, {113, -10}, {120, -36}, {140, -50}, {180, -54}};
    for (std::size_t k = 1; k < std::size(knots); ++k) {
        if (azimuth_degrees > knots[k].azimuth) continue;
        const double t = (azimuth_degrees - knots[k - 1].azimuth) / (knots[k].azimuth - knots[k - 1].azimuth);
        return mix(knots[k - 1].y, knots[k].y, smooth_step(0, 1, t));
    }
    return std::end(knots)[-1].y;
}

constexpr double fade_begin = -6, fade_end = 10;  // of the hairline, mm

/// Coordinates along and across the strands, which run from the whorl at the crown's back.
struct Strand {
    double along, across;
};
Strand strand(const Vec3& p) {
    const Vec3 whorl = hair_whorl();
    const Vec3 side = glm::normalize(glm::cross(whorl, Vec3(0, 0, 1))), other = glm::cross(whorl, side);
    const Vec3 d = glm::normalize(p - Vec3(0, 20, -5));
    const double along = std::acos(std::clamp(glm::dot(d, whorl), -1.0, 1.0));
    return {along, std::atan2(glm::dot(d, side), glm::dot(d, other)) + 0.35 * along};
}

}  // namespace

double above_hairline(const Vec3& p) { return p.y - hairline(std::atan2(std::abs(p.x), p.z + 5) * 180 / pi); }

Vec3 hair_whorl() { return glm::normalize(Vec3(0.12, 0.80, -0.62)); }

double hair_cover(const Vec3& p) { return smooth_step(fade_begin, fade_end, above_hairline(p)); }

double hair_thickness(const Vec3& p) { return hair_cover(p) * mix(0.4, 1.2, smooth_step(-40, 95, p.y)); }

double hair_paint(const Vec3& p) {
    const double above = above_hairline(p);
    if (above < 2 * fade_begin) return 0;
    if (above > 2 * fade_end) return 1;
    const Strand s = strand(p);
    const double a = std::cos(s.across), b = std::sin(s.across);
    const double wisp = 1.8 * noise({a * 60, b * 60, s.along * 9}) + 3.0 * noise({a * 170, b * 170, s.along * 26});
    return smooth_step(fade_begin + 1, fade_end - 2, above + wisp);
}

void grow_hair(Head& head) {
    for (Index v = 0; v < head.mesh.positions.size(); ++v) {
        Vec3& p = head.mesh.positions[v];
        if (head.tags[v].part != Part::skin || p.x < 0 || head.image[v] < v) continue;
        if (hair_cover(p) <= 0) continue;
        const double thickness = hair_thickness(p);  // strips stand on it
        const Strand s = strand({std::abs(p.x), p.y, p.z});
        const double tuft = noise({std::cos(s.across) * 7, std::sin(s.across) * 7, s.along * 2.5});
        const bool middle = p.x == 0;
        p += head.mesh.normals[v] * (thickness * (1 + 0.10 * tuft));
        if (middle) p.x = 0;
        if (head.image[v] != v) head.mesh.positions[head.image[v]] = mirrored(p);
    }
    head.mesh.normals = head_normals(head, head.mesh.positions);
}

double hair_relief(const Vec3& p) {
    const Strand s = strand(p);
    const double a = std::cos(s.across), b = std::sin(s.across);
    return 0.16 * noise({a * 110, b * 110, s.along * 5}) + 0.55 * noise({a * 26, b * 26, s.along * 3.2});
}

double hair_shade(const Vec3& p) {
    const Strand s = strand(p);
    const double a = std::cos(s.across), b = std::sin(s.across);
    const double fine = noise({a * 110, b * 110, s.along * 5}), broad = noise({a * 26, b * 26, s.along * 3.2});
    // Hair stands above it: the scalp's own lies in its shade.
    return 0.34 * std::clamp(0.75 + 0.35 * fine + 0.25 * broad, 0.2, 1.4);
}

}  // namespace blush::make_face
