#include "tools/make_face/brow_cards.h"

#include "rig/random.h"

namespace blush::make_face {
namespace {
constexpr double brow_head_x = 9.0, brow_length = 40;
}

BrowLine brow_line(double s) {
    const double arch = 4.6 * std::sin(pi * 0.5 * std::clamp(s / 0.68, 0.0, 1.0));
    const double fall = 6.5 * square(std::max(0.0, s - 0.66) / 0.34);
    return {{brow_head_x + brow_length * s, 19.2 + arch - fall},
            mix(3.6, 0.9, smooth_step(0.25, 1.05, s)) * mix(0.6, 1, smooth_step(-0.03, 0.12, s)),
            radians(mix(70, -12, smooth_step(0, 0.75, s)))};
}

double brow_cover(const Vec3& p) {
    const double s = (std::abs(p.x) - brow_head_x) / brow_length;
    if (s < -0.1 || s > 1.1 || p.z < 20 || p.y < 5 || p.y > 40) return 0;
    const BrowLine line = brow_line(s);
    // The hairs lean upward from their roots, so that they cover more above the line than below it.
    const double across = std::abs(p.y - line.middle.y - 0.6) / (line.half_width + 0.8);
    return smooth_step(1.35, 0.3, across) * smooth_step(-0.05, 0.12, s) * smooth_step(1.06, 0.86, s);
}

BrowCards make_brow_cards(const Head& head) {
    constexpr int cards_a_side = 150, segments = 3;
    BrowCards cards;
    std::vector<Vec2> places;
    std::vector<double> off;
    Random random(71);
    for (const double side : {1.0, -1.0}) {
        for (int n = 0; n < cards_a_side; ++n) {
            const double s = 0.97 * std::pow((n + random.between(0, 1)) / cards_a_side, 0.82);
            const BrowLine line = brow_line(s);
            // Dense in the middle, thin at the edges.
            const double across = 0.75 * (random.between(-1, 1) + random.between(-1, 1));
            // Hairs of the upper edge lie down and those of the lower edge rise, so that they meet in a ridge.
            const double lean = line.lean - 0.55 * across * smooth_step(0.08, 0.4, s) + random.between(-0.2, 0.2);
            const Vec2 along(std::cos(lean), std::sin(lean)), beside(-along.y, along.x);
            const double length = mix(7.4, 5.0, s) * random.between(0.8, 1.15) * mix(0.6, 1, smooth_step(0, 0.18, s));
            const double half_width =
                mix(1.05, 0.75, s) * random.between(0.85, 1.15) * mix(0.6, 1, smooth_step(0, 0.2, s));
            const Vec2 root = line.middle + Vec2(0, across * line.half_width) - along * (0.30 * length);
            const double lift = random.between(0.35, 0.8);
            const bool flipped = random.unit() < 0.5;
            for (int k = 0; k <= segments; ++k) {
                const double t = static_cast<double>(k) / segments;
                const Vec2 bent = root + along * (length * t) + beside * (-0.05 * length * t * t);
                for (const double edge : {1.0, -1.0}) {
                    Vec2 place = bent + beside * (edge * half_width * mix(1, 0.7, t));
                    place.x *= side;
                    places.push_back(place);
                    off.push_back(0.12 + lift * std::sin(pi * mix(0.04, 0.85, t)));
                    cards.mesh.uv.emplace_back((edge > 0) != flipped ? 0.02 : 0.98, mix(0.01, 0.99, t));
                }
            }
        }
    }
    cards.anchors = anchors_from_front(head, places);
    for (std::size_t v = 0; v < places.size(); ++v) {
        const Vec3 normal = glm::normalize(cards.anchors[v].interpolated(head.mesh.normals));
        cards.mesh.positions.push_back(cards.anchors[v].interpolated(head.mesh.positions) + normal * off[v]);
        cards.mesh.normals.push_back(normal);
    }
    constexpr Index rows = segments + 1;
    for (Index card = 0; card < 2 * cards_a_side; ++card) {
        const bool left = card < cards_a_side;
        for (Index k = 0; k < segments; ++k) {
            const Index a = 2 * (card * rows + k);
            if (left)
                cards.mesh.add_quad(a, a + 1, a + 3, a + 2);
            else
                cards.mesh.add_quad(a + 1, a, a + 2, a + 3);
        }
    }
    return cards;
}

}  // namespace blush::make_face
