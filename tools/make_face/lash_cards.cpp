#include "tools/make_face/lash_cards.h"

#include "rig/random.h"

namespace blush::make_face {
namespace {

struct Row {
    int cards, segments;
    double longest, half_width, upward;
    std::uint64_t seed;
};

void add_row(const Head& head, const std::vector<Index>& lid, const Row& row, Lashes& lashes) {
    Random random(row.seed);
    const std::size_t last = lid.size() - 1;
    for (int n = 0; n < row.cards; ++n) {
        const double t = mix(0.07, 0.985, (n + random.between(0.15, 0.85)) / row.cards);
        const double place = t * static_cast<double>(last);
        const auto k = std::min(static_cast<std::size_t>(place), last - 1);
        const Index edge = place - static_cast<double>(k) < 0.5 ? lid[k] : lid[k + 1];
        const std::vector<Vec3>& p = head.mesh.positions;
        const Vec3 root =
            glm::mix(p[lid[k]], p[lid[k + 1]], place - static_cast<double>(k)) - head.mesh.normals[edge] * 0.15;
        const Vec3 rim = glm::normalize(p[lid[k + 1]] - p[lid[k]]);
        // Short at the inner corner, longest two thirds outward, fanned to both sides.
        const double length = row.longest * mix(0.42, 1, smooth_step(0.0, 0.6, t)) *
                              mix(1, 0.8, smooth_step(0.85, 1, t)) * random.between(0.82, 1.1);
        const double fan = mix(-0.42, 0.85, t) + random.between(-0.10, 0.10);
        const Vec3 out = glm::normalize(Vec3(fan, 0, 1));
        const bool flipped = random.unit() < 0.5;
        Vec3 at = root;
        const auto first = static_cast<Index>(lashes.mesh.positions.size());
        for (int s = 0; s <= row.segments; ++s) {
            const double u = static_cast<double>(s) / row.segments;
            const Vec3 half = rim * (row.half_width * mix(1, 1.25, u));
            lashes.mesh.add(at - half, {flipped ? 0.98 : 0.02, mix(0.01, 0.99, u)});
            lashes.mesh.add(at + half, {flipped ? 0.02 : 0.98, mix(0.01, 0.99, u)});
            lashes.edge.insert(lashes.edge.end(), {edge, edge});
            // First forward and a little against the lid's way, then curling off it.
            const double climb = row.upward * mix(-0.35, 1.5, u);
            at += glm::normalize(out + Vec3(0, climb, 0)) * (length / row.segments);
        }
        for (Index s = 0; s < static_cast<Index>(row.segments); ++s) {
            const Index a = first + 2 * s;
            lashes.mesh.add_quad(a, a + 1, a + 3, a + 2);
        }
    }
}

}  // namespace

Lashes make_lash_cards(const Head& head) {
    Lashes lashes;
    add_row(head, head.upper_lid, {38, 5, 8.6, 1.25, 0.95, 10}, lashes);
    add_row(head, head.lower_lid, {26, 3, 4.0, 0.95, -0.8, 500}, lashes);
    lashes.image = mirror_across_x(lashes.mesh);
    const std::size_t half = lashes.edge.size();
    for (std::size_t v = 0; v < half; ++v) lashes.edge.push_back(head.image[lashes.edge[v]]);
    lashes.mesh.normals = smooth_normals(lashes.mesh);
    return lashes;
}

}  // namespace blush::make_face
