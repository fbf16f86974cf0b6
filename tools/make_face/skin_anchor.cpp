#include "tools/make_face/skin_anchor.h"

#include <limits>

#include "tools/make_face/parallel.h"

namespace blush::make_face {
namespace {

bool is_bare_skin(const Head& head, const Triangle& t) {
    return std::ranges::all_of(t, [&](Index v) { return head.tags[v].part == Part::skin; });
}

SkinAnchor nearest_vertex(const Head& head, const Vec3& place, const auto& distance2) {
    Index nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (Index v = 0; v < head.mesh.positions.size(); ++v) {
        if (head.tags[v].part != Part::skin) continue;
        const double d = distance2(head.mesh.positions[v], place);
        if (d >= least) continue;
        least = d;
        nearest = v;
    }
    return {{nearest, nearest, nearest}, {1, 0, 0}};
}

}  // namespace

std::vector<SkinAnchor> anchors_from_front(const Head& head, std::span<const Vec2> places) {
    Vec2 low(1e9), high(-1e9);
    for (const Vec2& place : places) {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    const std::vector<Vec3>& p = head.mesh.positions;
    std::vector<Triangle> near;
    for (const Triangle& t : head.mesh.triangles) {
        if (!is_bare_skin(head, t)) continue;
        const Vec3 least = glm::min(p[t[0]], glm::min(p[t[1]], p[t[2]]));
        const Vec3 most = glm::max(p[t[0]], glm::max(p[t[1]], p[t[2]]));
        if (least.x > high.x || most.x < low.x || least.y > high.y || most.y < low.y || most.z < 0) continue;
        near.push_back(t);
    }
    std::vector<SkinAnchor> anchors(places.size());
    parallel_pieces(static_cast<int>(places.size()), [&](int first, int last) {
        for (int n = first; n < last; ++n) {
            const Vec2& place = places[static_cast<std::size_t>(n)];
            SkinAnchor& anchor = anchors[static_cast<std::size_t>(n)];
            double foremost = -std::numeric_limits<double>::infinity();
            for (const Triangle& t : near) {
                const Vec3 &a = p[t[0]], &b = p[t[1]], &c = p[t[2]];
                const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
                if (area <= 1e-12) continue;  // seen from behind, or edge-on
                const double wa = ((b.x - place.x) * (c.y - place.y) - (c.x - place.x) * (b.y - place.y)) / area;
                const double wb = ((c.x - place.x) * (a.y - place.y) - (a.x - place.x) * (c.y - place.y)) / area;
                const double wc = 1 - wa - wb;
                if (std::min({wa, wb, wc}) < 0) continue;
                const double z = a.z * wa + b.z * wb + c.z * wc;
                if (z <= foremost) continue;
                foremost = z;
                anchor = {t, {wa, wb, wc}};
            }
            if (std::isfinite(foremost)) continue;
            anchor = nearest_vertex(head, Vec3(place, 0), [](const Vec3& v, const Vec3& q) {
                return v.z < 0 ? 1e9 : square(v.x - q.x) + square(v.y - q.y);
            });
        }
    });
    return anchors;
}

std::vector<SkinAnchor> nearest_anchors(const Head& head, std::span<const Vec3> places) {
    std::vector<SkinAnchor> anchors(places.size());
    parallel_pieces(static_cast<int>(places.size()), [&](int first, int last) {
        for (int n = first; n < last; ++n) {
            anchors[static_cast<std::size_t>(n)] =
                nearest_vertex(head, places[static_cast<std::size_t>(n)], [](const Vec3& a, const Vec3& b) {
                    const Vec3 d = a - b;
                    return glm::dot(d, d);
                });
        }
    });
    return anchors;
}

std::vector<ShapeTarget> carried_targets(const Mesh& mesh, std::span<const SkinAnchor> anchors, const Head& head,
                                         std::span<const ShapeTarget> head_targets) {
    constexpr double least_move_mm = 0.01;
    std::vector<ShapeTarget> targets;
    for (const ShapeTarget& source : head_targets) {
        ShapeTarget target;
        target.name = source.name;
        bool moves = false;
        for (std::size_t v = 0; v < anchors.size(); ++v) {
            const SkinAnchor& anchor = anchors[v];
            const Vec3 delta = anchor.interpolated(source.position_deltas);
            const Vec3 rest = glm::normalize(anchor.interpolated(head.mesh.normals));
            const Vec3 turned = glm::normalize(rest + anchor.interpolated(source.normal_deltas));
            // The shortest turn from one normal to the other (Rodrigues), on the card's own.
            const Vec3 axis = glm::cross(rest, turned);
            const double cosine = glm::dot(rest, turned);
            const Vec3& n = mesh.normals[v];
            const Vec3 rotated = n * cosine + glm::cross(axis, n) + axis * (glm::dot(axis, n) / (1 + cosine));
            target.position_deltas.push_back(delta);
            target.normal_deltas.push_back(cosine > -0.9 ? rotated - n : Vec3(0));
            moves = moves || glm::length(delta) > least_move_mm;
        }
        if (moves) targets.push_back(std::move(target));
    }
    return targets;
}

}  // namespace blush::make_face
