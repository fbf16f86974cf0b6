#include "tools/make_face/skin_detail.h"

#include "tools/make_face/brow_cards.h"
#include "tools/make_face/cells.h"
#include "tools/make_face/hair.h"
#include "tools/make_face/head_shape.h"
#include "tools/make_face/skin_regions.h"

namespace blush::make_face {
namespace {

/// Distance to the nearest scattered point, in cells; right up to half a cell.
double cell_distance(const Vec3& q) {
    double least = 9;
    each_cell(q, [&](const Cell& c) {
        const Vec3 d = q - c.point;
        least = std::min(least, glm::dot(d, d));
    });
    return std::sqrt(least);
}

/// A net of thin furrows: -1 in them, 0 between. `stretch`: how much longer than wide the meshes are, along x of q.
double furrow(double x, double cell, double sharpness) {
    return -std::pow(1 - std::min(1.0, std::abs(x) / cell), sharpness);
}

/// Height of the skin over its mean surface, millimetres.
double relief(const SurfaceTexel& texel, double aged) {
    const Vec3 p = texel.place(), half = texel.half();
    if (texel.part == Part::mouth_lining || texel.part == Part::lid_lining) return 0.010 * noise(p / 0.8);
    if (texel.part == Part::skin && hair_paint(p) > 0.5) return 0.5 * hair_relief(p);

    const double lip = texel.part == Part::skin ? lip_cover(p) : 0;
    const double eye = around_eye(half), wide = wide_pored(half);
    const double forehead = bell(half, {0, 44, 84}, {52, 22, 40});
    double h = 0;
    if (lip < 1) {
        // Pores: pits of 0.15 to 0.3 mm, a millimetre apart where they are widest.
        const double cell = 1.05;
        const double pit = smooth_step(0.42, 0.10, cell_distance(p / cell));
        double skin = -0.19 * mix(0.25, 1.0, wide) * (1 - 0.85 * eye) * pit;
        // Primary lines: two families that cross, bent by a slow noise (Mac-Neil 1: skin relief is a net of rhombs).
        const double bend = 2.2 * noise(p / 5.0);
        constexpr double head_radius = 76;  // so that u is a length along the skin, also on the sides of the face
        const double u = head_radius * std::atan2(p.x, p.z + 12), v = p.y;
        const double mesh = mix(1.15, 0.75, std::max(eye, 0.6 * wide));
        const double across = noise({(0.80 * u + 0.60 * v) / mesh + bend, (0.80 * v - 0.60 * u) / (2.3 * mesh), 3.5});
        const double other = noise({(0.74 * u - 0.67 * v) / mesh - bend, (0.74 * v + 0.67 * u) / (2.3 * mesh), 9.5});
        skin += (0.032 + 0.016 * eye) * (furrow(across, 0.5, 2) + furrow(other, 0.5, 2));
        // The forehead's fine lines lie across it; those about the eye run out from its corner.
        skin += 0.055 * forehead * furrow(noise({u / 16, v / 1.7 + 0.6 * noise(p / 9.0), 1.5}), 0.4, 2);
        const Vec3 from_corner = half - Vec3(44, -2, 62);
        const double fan = std::atan2(from_corner.y, from_corner.x + 8);
        skin += 0.040 * bell(from_corner, Vec3(0), {14, 12, 16}) *
                furrow(noise({fan * 9, glm::length(from_corner) / 9, 6.5}), 0.35, 2);
        skin += 0.045 * smooth_step(-105, -122, p.y) * furrow(noise({u / 22, v / 4.2 + noise(p / 15.0), 2.5}), 0.25, 2);
        if (aged > 0) {
            // Folds that stay: across the forehead, out from the eye's corner, below the eye, around the neck.
            skin += aged * 0.55 * forehead * furrow(noise({u / 60, v / 7.5 + 0.5 * noise(p / 24.0), 5.5}), 0.22, 2);
            skin += aged * 0.40 * bell(from_corner, Vec3(0), {15, 13, 18}) *
                    furrow(noise({fan * 5, glm::length(from_corner) / 26, 2.5}), 0.25, 2);
            skin += aged * 0.28 * bell(half, {30, -15, 78}, {14, 6, 14}) *
                    furrow(noise({u / 18, (v + 0.25 * u) / 3.4, 7.5}), 0.25, 2);
            skin += aged * 0.45 * smooth_step(-105, -122, p.y) *
                    furrow(noise({u / 50, v / 11 + noise(p / 25.0), 4.5}), 0.15, 2);
            skin += aged * 0.08 * (furrow(across, 0.6, 2) + furrow(other, 0.6, 2));
        }
        // Slow unevenness: no skin is a smooth shell.
        skin += 0.075 * noise(p / 3.4) + 0.035 * noise(p / 1.3);
        h = skin * (1 - lip);
    }
    if (lip > 0) {
        const double bend = 0.5 * noise(p / 3.0);
        const double upright = noise({p.x / 0.85 + bend, p.y / 7.0, 4.5}),
                     finer = noise({p.x / 0.42 - bend, p.y / 3.5, 8.5});
        h += lip * (0.12 * furrow(upright, 0.42, 1.6) + 0.05 * furrow(finer, 0.4, 2) + 0.02 * noise(p / 1.4));
    }
    return h;
}

}  // namespace

Picture paint_relief(const SurfaceTexels& texels, double aged) {
    const int side = texels.side();
    std::vector<double> height(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0);
    texels.for_each([&](int, int, const SurfaceTexel& texel, std::size_t k) { height[k] = relief(texel, aged); });
    Picture picture(side, side, 3, 128);
    for (std::size_t k = 2; k < picture.bytes.size(); k += 3) picture.bytes[k] = 255;
    // Slopes by central differences between texels, over the way between their places on the skin; one-sided at the
    // charts' edges.
    const auto slope = [&](int x, int y, int dx, int dy) {
        const auto joined = [&](int nx, int ny) {
            if (nx < 0 || nx >= side || ny < 0 || ny >= side || !texels.at(nx, ny).covered) return false;
            constexpr float torn_mm = 4;  // over an edge between two charts
            return glm::distance(texels.at(nx, ny).p, texels.at(x, y).p) < torn_mm;
        };
        const int bx = joined(x - dx, y - dy) ? x - dx : x, by = joined(x - dx, y - dy) ? y - dy : y;
        const int ax = joined(x + dx, y + dy) ? x + dx : x, ay = joined(x + dx, y + dy) ? y + dy : y;
        const double way = static_cast<double>(glm::distance(texels.at(ax, ay).p, texels.at(bx, by).p));
        const auto h = [&](int hx, int hy) {
            return height[static_cast<std::size_t>(hy) * static_cast<std::size_t>(side) + static_cast<std::size_t>(hx)];
        };
        return way > 1e-3 ? std::clamp((h(ax, ay) - h(bx, by)) / way, -1.0, 1.0) : 0.0;
    };
    texels.for_each([&](int x, int y, const SurfaceTexel&, std::size_t) {
        const Vec3 n = glm::normalize(Vec3(-slope(x, y, 1, 0), slope(x, y, 0, 1), 1));  // green is up, v is down
        picture.set(x, y, n * 0.5 + 0.5);
    });
    texels.fill_margins(std::span(picture.bytes), 3);
    return picture;
}

Picture paint_roughness(const SurfaceTexels& texels) {
    // Beckmann's m is 0.6 times it. Weyrich et al. 2006 fit m of 0.2 (nose, forehead) to 0.4 (cheeks), recalled, and
    // intensities of a fifth to a half of what a smooth surface would reflect.
    constexpr double dry = 0.54, shining = 0.34, lips = 0.32, hair = 1, wet = 0.16;
    Picture picture(texels.side(), texels.side(), 3, 0);
    for (std::size_t k = 0; k < picture.bytes.size(); k += 3) {
        picture.bytes[k] = 255;
        picture.bytes[k + 1] = to_byte(dry);
    }
    texels.for_each([&](int x, int y, const SurfaceTexel& texel, std::size_t) {
        const Vec3 p = texel.place(), half = texel.half();
        double roughness = mix(dry, shining, oily(half)) + 0.05 * fractal_noise(p / 2.2, 2) - 0.03 * around_eye(half) +
                           0.2 * temple(half);
        double seen = 1;
        if (texel.part == Part::skin) {
            roughness = mix(roughness, lips + 0.05 * noise(p / 1.5), 0.9 * lip_cover(p));
            roughness = mix(roughness, wet, 0.8 * lid_rim(p, false));
            const double scalp = hair_paint(p);
            roughness = mix(roughness, hair, std::max(scalp, 0.6 * brow_cover(p)));
            seen *= 1 - 0.75 * nostril(texel);
            seen *= 1 - 0.5 * lip_seam(p);
            // Under the fringe and the hair at the temples.
            seen *= 1 - 0.45 * smooth_step(-20, 4, above_hairline(p)) * (1 - scalp) - 0.4 * scalp;
            seen *= 1 - 0.35 * bell(half, {31, 9, 80}, {15, 4, 9}) - 0.3 * bell(half, {17, -1, 79}, {4, 5, 6});
        }
        if (texel.part == Part::ear) seen *= 1 - 0.5 * bell(half, landmark::ear_centre + Vec3(0, -3, 5), {9, 6, 6});
        const double depth = static_cast<double>(texel.depth);
        if (texel.part == Part::mouth_lining || texel.part == Part::lid_lining)
            roughness = mix(lips, wet, smooth_step(0, 0.2, depth));
        if (texel.part == Part::mouth_lining) {
            seen *= mix(0.8, 0.1, smooth_step(0.05, 0.5, depth));
            roughness = mix(roughness, 1, smooth_step(0.25, 0.5, depth));
        }
        picture.set(x, y, {seen, roughness, 0});
    });
    texels.fill_margins(std::span(picture.bytes), 3);
    return picture;
}

Picture paint_specular(const SurfaceTexels& texels) {
    Picture picture(texels.side(), texels.side(), 4, 255);
    texels.for_each([&](int x, int y, const SurfaceTexel& texel, std::size_t) {
        const Vec3 p = texel.place(), half = texel.half();
        double intensity = mix(0.38, 0.85, oily(half)) * (1 - 0.5 * temple(half)) + 0.08 * fractal_noise(p / 3.0, 2);
        if (texel.part == Part::skin) {
            intensity = mix(intensity, 0.9, lip_cover(p));
            intensity = mix(intensity, 0.05, std::max(hair_paint(p), 0.5 * brow_cover(p)));
            intensity *= (1 - 0.95 * nostril(texel)) * (1 - 0.7 * lip_seam(p));
        }
        if (texel.part == Part::lid_lining) intensity = 1;
        if (texel.part == Part::mouth_lining)
            intensity = mix(0.9, 0.0, smooth_step(0.15, 0.5, static_cast<double>(texel.depth)));
        picture.at(x, y)[3] = to_byte(intensity);
    });
    texels.fill_margins(std::span(picture.bytes), 4);
    return picture;
}

}  // namespace blush::make_face
