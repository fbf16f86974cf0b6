#include "tools/make_face/hair_cards.h"

#include "rig/random.h"
#include "tools/make_face/hair.h"
#include "tools/make_face/head_shape.h"
#include "tools/make_face/strands.h"

namespace blush::make_face {
namespace {

const Vec3 skull_centre(0, 20, -5);

Vec3 along_surface(const Vec3& v, const Vec3& normal) { return v - normal * glm::dot(v, normal); }

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
    const double length = glm::length(v);
    return length > 1e-9 ? v / length : otherwise;
}

/// 1 over the forehead and the top of the head, 0 on its sides and at the nape.
double on_top(const Vec3& p) { return smooth_step(22, 78, p.y + 0.12 * p.z); }

/// The way hair is combed at a place of the scalp.
Vec3 combed(const Vec3& p, const Vec3& normal, const HairStyle& style) {
    const Vec3 whorl = hair_whorl();
    const Vec3 d = glm::normalize(p - skull_centre);
    Vec3 way = unit_or(along_surface(-whorl, d), Vec3(0, -1, 0));
    // About the whorl it turns before it goes outward.
    way += 0.9 * glm::cross(whorl, way) * bell(std::acos(std::clamp(glm::dot(d, whorl), -1.0, 1.0)), 0.35);
    const double top = on_top(p), front = smooth_step(0, 75, p.z);
    way += Vec3(-0.85 * style.sweep, 0, 0.1) * top * front;
    way += Vec3(0, -0.7, 0) * (1 - top);                              // by its weight
    way += Vec3(0, 0, -0.75) * (1 - top) * smooth_step(20, 50, p.z);  // temples: back, off the face
    way += 0.34 * Vec3(noise(p / 17.0), noise(p / 17.0 + Vec3(31, 0, 0)), noise(p / 17.0 + Vec3(0, 57, 0)));
    return unit_or(along_surface(way, normal), Vec3(0, -1, 0));
}

struct Layer {
    int directions;                  ///< spread over the whole sphere; those over hair carry a strip
    double top_height, side_height;  ///< of the strip's middle over the scalp, mm
    bool shaded;
    double width;
    double above;         ///< millimetres above the hairline from where it grows
    double reach = 1000;  ///< and up to where
    double length = 1;    ///< factor on it
};

}  // namespace

HairCards make_hair_cards(const HairStyle& style) {
    constexpr Layer layers[] = {
        {320, 2.2, 1.3, true, 1.8, 8, 1000, 0.5}, {480, 3.8, 2.0, false, 1.3, 2},
        {1100, 2.0, 1.2, false, 0.8, -3, 7, 0.7},  // the hairline: narrow and sparse
        {560, 5.4, 2.7, false, 1.1, 4},           {480, 7.0, 3.4, false, 1.0, 6},
        {240, 8.6, 4.2, false, 0.8, 9},
    };
    HairCards cards;
    Random random(5);
    const Vec3 whorl_place = leave_head(skull_centre, hair_whorl());
    for (const Layer& layer : layers) {
        const double turn = random.between(0, 6.28);
        for (int n = 0; n < layer.directions; ++n) {
            // Evenly over the sphere by the golden angle, then shaken.
            constexpr double golden_angle = 2.39996322972865332;
            const double height = 1 - 2 * (n + 0.5) / layer.directions, around = turn + golden_angle * n;
            const double ring = std::sqrt(1 - height * height);
            Vec3 direction(ring * std::cos(around), height, ring * std::sin(around));
            direction += 0.05 * Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
            const double length_luck = random.unit(), width_luck = random.unit(), roll = random.between(-1, 1),
                         turn_luck = random.between(-1, 1), lift_luck = random.between(0.75, 1.25);
            const int clump = layer.reach < 100 ? static_cast<int>(random.between(0, sparse_hair_clumps))
                                                : static_cast<int>(random.between(sparse_hair_clumps, hair_clumps));
            const bool flipped = random.unit() < 0.5;
            if (direction.y < -0.75) continue;
            Vec3 q = leave_head(skull_centre, glm::normalize(direction));
            const double above = above_hairline(q) - layer.above;
            if (above < 0 || above > layer.reach) continue;

            const double top = on_top(q);
            // Shorter at the hairline, where new hair grows, and toward the nape.
            const double grown = mix(0.62, 1, smooth_step(0, 16, above));
            const double length = style.length * layer.length * grown *
                                  mix(mix(17, 27, smooth_step(-50, 40, q.y)), 42, top) * mix(0.82, 1.2, length_luck);
            const double half_width = 0.5 * layer.width * mix(4.6, 6.4, top) * mix(0.8, 1.2, width_luck) *
                                      mix(0.5, 1, smooth_step(0, 14, above));
            const double raised = style.lift * lift_luck * mix(layer.side_height, layer.top_height, top) *
                                  mix(0.45, 1, smooth_step(0, 22, above)) *
                                  (1 - 0.45 * bell(glm::distance(q, whorl_place), 30));
            const int segments = top > 0.5 ? 5 : 3;
            // At the hairline nothing lies above that would shade it.
            const ClumpArea area = hair_clump(clump, layer.shaded && above > 34);
            const double left = flipped ? area.right : area.left, right = flipped ? area.left : area.right;
            const Vec3 root = q;
            const auto first = static_cast<Index>(cards.mesh.positions.size());
            for (int s = 0; s <= segments; ++s) {
                const double t = static_cast<double>(s) / segments;
                const Vec3 normal = head_normal(q);
                Vec3 way = combed(q, normal, style);
                const Vec3 beside = glm::cross(way, normal);
                way = glm::normalize(way + beside * (0.20 * turn_luck));
                // Hair leaves the scalp at a slant, then lies on what is below it; tips stand off a little.
                const double off = hair_thickness(q) + raised * (0.12 + 0.88 * smooth_step(0, 0.45, t)) +
                                   1.6 * style.lift * t * t * roll;
                const Vec3 side = glm::normalize(glm::cross(way, normal) + normal * (0.35 * roll));
                const double half = half_width * mix(0.85, 1.0, smooth_step(0, 0.3, t)) * mix(1, 0.75, t);
                const Vec3 p = q + normal * off;
                cards.mesh.add(p - side * half, {left, mix(area.top, area.bottom, t)});
                cards.mesh.add(p + side * half, {right, mix(area.top, area.bottom, t)});
                // Shaded as a part of the whole head of hair, not as a flat strip: bent outward at its sides.
                const Vec3 round = glm::normalize(normal * 0.8 + glm::normalize(p - skull_centre) * 0.4);
                cards.mesh.normals.push_back(glm::normalize(round - side * 0.25));
                cards.mesh.normals.push_back(glm::normalize(round + side * 0.25));
                cards.roots.insert(cards.roots.end(), {root, root});
                q = project_to_head(q + way * (length / segments));
            }
            for (Index s = 0; s < static_cast<Index>(segments); ++s) {
                const Index a = first + 2 * s;
                cards.mesh.add_quad(a, a + 1, a + 3, a + 2);
                cards.mesh.add_quad(a, a + 2, a + 3, a + 1);
            }
        }
    }
    return cards;
}

}  // namespace blush::make_face
