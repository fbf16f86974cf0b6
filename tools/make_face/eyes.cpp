#include "tools/make_face/eyes.h"

#include "tools/make_face/head_shape.h"

namespace blush::make_face {

double eye_radius_at(double polar) {
    return landmark::eye_radius + cornea_height * smooth_step(limbus_angle * 1.15, 0, polar);
}

Mesh make_eye() {
    constexpr int around = 40, rings = 30;
    Mesh mesh;
    const auto ring_angle = [](int ring) { return pi * std::pow(static_cast<double>(ring) / rings, 1.25); };
    for (int ring = 0; ring <= rings; ++ring) {
        const double polar = ring_angle(ring);
        const double radius = eye_radius_at(polar);
        for (int k = 0; k < around; ++k) {
            const double turn = 2 * pi * k / around;
            const Vec3 direction(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
            const double r = std::min(polar / eye_texture_angle, 1.0) * 0.5;
            mesh.add(direction * radius, {0.5 + r * std::cos(turn), 0.5 - r * std::sin(turn)});
        }
    }
    const auto at = [&](int ring, int k) {
        return ring == 0 || ring == rings ? static_cast<Index>(ring * around)
                                          : static_cast<Index>(ring * around + k % around);
    };
    for (int ring = 0; ring < rings; ++ring)
        for (int k = 0; k < around; ++k)
            mesh.add_quad(at(ring, k), at(ring + 1, k), at(ring + 1, k + 1), at(ring, k + 1));
    mesh.normals = smooth_normals(mesh);
    return mesh;
}

Mesh make_caruncles() {
    // Some 5 mm long and 3 mm high, between the lids and before the ball.
    constexpr int around = 14, rings = 9;
    constexpr Vec3 centre{19.4, -2.5, 74.6}, radii{2.7, 1.9, 2.3};
    Mesh mesh;
    for (int ring = 0; ring <= rings; ++ring) {
        const double polar = pi * ring / rings;
        for (int k = 0; k < around; ++k) {
            const double turn = 2 * pi * k / around;
            const Vec3 direction(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
            mesh.add(centre + radii * direction, {static_cast<double>(k) / around, static_cast<double>(ring) / rings});
        }
    }
    for (Index ring = 0; ring < rings; ++ring) {
        for (Index k = 0; k < around; ++k) {
            const auto at = [&](Index row, Index j) {
                return row == 0 || row == rings ? row * around : row * around + j % around;
            };
            mesh.add_quad(at(ring, k), at(ring + 1, k), at(ring + 1, k + 1), at(ring, k + 1));
        }
    }
    mirror_across_x(mesh);
    mesh.normals = smooth_normals(mesh);
    return mesh;
}

Lashes make_lashes(const Head& head) {
    constexpr int segments = 4;
    Lashes lashes;
    const auto add_row = [&](const std::vector<Index>& lid, int count, double longest, double upward, double seed) {
        const std::size_t last = lid.size() - 1;
        for (int n = 0; n < count; ++n) {
            const double t = mix(0.10, 0.98, (n + 0.5 + 0.3 * noise({seed + 1.7 * n, 0.5, 0.5})) / count);
            const double place = t * static_cast<double>(last);
            const auto k = std::min(static_cast<std::size_t>(place), last - 1);
            const Index edge = place - static_cast<double>(k) < 0.5 ? lid[k] : lid[k + 1];
            const Vec3 root =
                glm::mix(head.mesh.positions[lid[k]], head.mesh.positions[lid[k + 1]], place - static_cast<double>(k)) -
                head.mesh.normals[edge] * 0.1;
            // Forward off the eye, fanning to both sides, curling up (down for the lower lid) toward the tip.
            const double length = longest * mix(0.55, 1, std::sin(pi * std::min(1.0, 0.15 + 0.75 * t))) *
                                  (1 + 0.18 * noise({seed + 3.1 * n, 2.5, 0.5}));
            const double fan = mix(-0.35, 0.95, t) + 0.12 * noise({seed + 2.3 * n, 4.5, 0.5});
            const Vec3 out = glm::normalize(Vec3(fan, 0.0, 1.0));
            const double half_width = 0.16;
            Vec3 p = root;
            const auto first = static_cast<Index>(lashes.mesh.positions.size());
            for (int s = 0; s <= segments; ++s) {
                const double u = static_cast<double>(s) / segments;
                const Vec3 side = Vec3(half_width * (1 - u), 0, -half_width * (1 - u) * fan * 0.5);
                lashes.mesh.add(p - side, {0.5, u});
                lashes.mesh.add(p + side, {0.5, u});
                lashes.edge.insert(lashes.edge.end(), {edge, edge});
                const double climb = upward * mix(-0.25, 1.15, u);
                p += glm::normalize(out + Vec3(0, climb, 0)) * (length / segments);
            }
            for (Index s = 0; s < segments; ++s) {
                const Index a = first + 2 * s;
                lashes.mesh.add_quad(a, a + 1, a + 3, a + 2);
            }
        }
    };
    add_row(head.upper_lid, 54, 7.5, 1.0, 10);
    add_row(head.lower_lid, 30, 3.6, -0.9, 500);
    lashes.image = mirror_across_x(lashes.mesh);
    const std::size_t half = lashes.edge.size();
    for (std::size_t v = 0; v < half; ++v) lashes.edge.push_back(head.image[lashes.edge[v]]);
    lashes.mesh.normals = smooth_normals(lashes.mesh);
    return lashes;
}

}  // namespace blush::make_face
