#include "tools/make_face/lids.h"

#include "tools/make_face/eyes.h"
#include "tools/make_face/head_shape.h"

namespace blush::make_face {
namespace {

using namespace landmark;

constexpr double upper_part = 0.8;                                      // of the way that a blink closes
constexpr double upper_reach = radians(44), lower_reach = radians(38);  // how far the skin follows beyond the edges
constexpr double clearance = 0.2;                                       // between lid and eyeball, mm

double angle_of(const Vec3& p) { return std::atan2(p.y - eye_centre.y, p.z - eye_centre.z); }

/// p turned by `angle` about the X axis through the eye's centre, up when positive.
Vec3 turned(const Vec3& p, double angle) {
    const Vec3 arm = p - eye_centre;
    return eye_centre + Vec3(arm.x, arm.y * std::cos(angle) + arm.z * std::sin(angle),
                             arm.z * std::cos(angle) - arm.y * std::sin(angle));
}

/// The same about the vertical axis, to the face's left when positive.
Vec3 turned_about_vertical(const Vec3& p, double angle) {
    const Vec3 arm = p - eye_centre;
    return eye_centre + Vec3(arm.x * std::cos(angle) + arm.z * std::sin(angle), arm.y,
                             arm.z * std::cos(angle) - arm.x * std::sin(angle));
}

/// How far q lies inside the eye about `centre` that looks forward, widened by the clearance; negative outside.
double lack_of_room(const Vec3& q, const Vec3& centre) {
    const Vec3 arm = q - centre;
    const double distance = glm::length(arm);
    return eye_radius_at(std::acos(std::clamp(arm.z / distance, -1.0, 1.0))) + clearance - distance;
}

}  // namespace

Lids::Lids(const Head& head) : head_(head) {}

Lids::Opening Lids::opening_at(double x) const {
    const auto edge_angle = [&](const std::vector<Index>& edge) {
        const auto at = [&](std::size_t k) { return head_.mesh.positions[edge[k]]; };
        std::size_t k = 0;
        while (k + 2 < edge.size() && at(k + 1).x < x) ++k;
        const double t = std::clamp((x - at(k).x) / (at(k + 1).x - at(k).x), 0.0, 1.0);
        return mix(angle_of(at(k)), angle_of(at(k + 1)), t);
    };
    return {edge_angle(head_.upper_lid), edge_angle(head_.lower_lid)};
}

Vec3 Lids::move(Index v, const LidMove& lid_move) const {
    const VertexTag& tag = head_.tags[v];
    const Vec3& p = head_.mesh.positions[v];
    if (tag.part == Part::ear || tag.part == Part::mouth_lining || p.x <= 0) return Vec3(0);
    if (glm::length(p - eye_centre) > 3 * eye_radius) return Vec3(0);
    const Vec3& edge = tag.part == Part::lid_lining ? head_.mesh.positions[tag.edge] : p;
    const Opening opening = opening_at(edge.x);
    const double gape = opening.upper - opening.lower;
    // Opening further (or turning at all) is in proportion to how open the eye is at this x: the corners stay.
    const double middle = std::min(1.0, gape / radians(30));

    const bool upper = tag.lid > 0;
    const double beyond = tag.part == Part::lid_lining ? 0
                          : upper                      ? angle_of(p) - opening.upper
                                                       : opening.lower - angle_of(p);
    const double follow = smooth_step(1, 0, std::max(0.0, beyond) / (upper ? upper_reach : lower_reach)) *
                          smooth_step(2.1 * eye_radius, 1.3 * eye_radius, glm::length(p - eye_centre));
    const double turn = upper ? -lid_move.close * upper_part * gape + radians(lid_move.upper_degrees) * middle
                              : lid_move.close * (1 - upper_part) * gape + radians(lid_move.lower_degrees) * middle;
    // The ball drags the skin that lies on it along, corners and all.
    const double drag =
        radians(lid_move.yaw_degrees) * smooth_step(2.0 * eye_radius, 1.1 * eye_radius, glm::length(edge - eye_centre));
    const Vec3 dragged = drag == 0 ? p : turned_about_vertical(p, drag);
    if (tag.lid == 0) return dragged - p;
    return turned(dragged, turn * follow) - p + Vec3(lid_move.sideways_mm * middle * follow, 0, 0);
}

void Lids::keep_off_eyes(std::vector<Vec3>& deltas) const {
    // A target's vertices go along chords, which dip into the ball between two places on it; the end is pushed outward
    // until every sampled weight clears.
    constexpr int weights = 8, most_rounds = 60;
    for (Index v = 0; v < deltas.size(); ++v) {
        const Vec3& p = head_.mesh.positions[v];
        if (deltas[v] == Vec3(0)) continue;
        const Vec3 centre = p.x < 0 ? mirrored(eye_centre) : eye_centre;
        if (glm::length(p - centre) > 2 * eye_radius) continue;
        const double allowed = std::max(0.0, lack_of_room(p, centre));  // what is tighter at rest may stay so
        for (int round = 0; round < most_rounds; ++round) {
            double lack = 0;
            for (int n = 1; n <= weights; ++n) {
                const double weight = static_cast<double>(n) / weights;
                lack = std::max(lack, (lack_of_room(p + deltas[v] * weight, centre) - allowed) / weight);
            }
            if (lack <= 0) break;
            deltas[v] += glm::normalize(p + deltas[v] - centre) * (0.6 * lack + 1e-4);
        }
    }
}

void Lids::join_edges(std::vector<Vec3>& deltas) const {
    for (std::size_t k = 0; k < head_.upper_lid.size(); ++k) {
        const Index u = head_.upper_lid[k], l = head_.lower_lid[k];
        const Vec3 up = head_.mesh.positions[u] + deltas[u], low = head_.mesh.positions[l] + deltas[l];
        const Vec3 meeting = glm::length(up - eye_centre) > glm::length(low - eye_centre) ? up : low;
        deltas[u] = meeting - head_.mesh.positions[u];
        deltas[l] = meeting - head_.mesh.positions[l];
    }
}

Vec3 Lids::carried(const Vec3& edge, const Vec3& delta, const Vec3& p) const {
    const bool right = edge.x < 0;
    const auto to_left = [&](const Vec3& q) { return right ? mirrored(q) : q; };
    const Vec3 from = to_left(edge), to = to_left(edge + delta);
    const double turn = angle_of(to) - angle_of(from);
    const Vec3 pushed = to - turned(from, turn);
    return to_left(turned(to_left(p), turn) + pushed);
}

}  // namespace blush::make_face
