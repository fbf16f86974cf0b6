#include "runtime/surface_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rig/deform/rest_places.h"
#include "runtime/character.h"
#include "runtime/effects/normals.h"
#include "runtime/frame/attached_point.h"
#include "runtime/frame/character_state.h"
#include "runtime/frame/stand.h"

namespace blush {
namespace {

bool finite(glm::dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// v / |v|, or `otherwise` where it has no direction.
glm::dvec3 unit_or(glm::dvec3 v, glm::dvec3 otherwise) {
    const double length = glm::length(v);
    return length > 1e-30 && std::isfinite(length) ? v / length : otherwise;
}

/// Cofactors: the inverse transpose up to a positive factor, finite for every matrix.
glm::dmat3 normal_matrix(const glm::dmat3& m) {
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(m[0], cofactors[0]) < 0 ? -cofactors : cofactors;
}

glm::dvec3 any_across(glm::dvec3 unit) {
    const glm::dvec3 axis = std::abs(unit.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(axis - unit * glm::dot(unit, axis));
}

/// Which primitive a triangle is of; none: of no primitive that a node draws.
const Primitive* drawn_primitive(const Face& face, std::uint32_t triangle) {
    const std::size_t first = std::size_t{3} * triangle;
    const auto found = std::ranges::find_if(face.primitives, [first](const Primitive& primitive) {
        return first >= primitive.first_index && first + 2 < std::size_t{primitive.first_index} + primitive.index_count;
    });
    return found != face.primitives.end() && drawing_node(face, found->mesh) >= 0 ? &*found : nullptr;
}

/// Entry of Stance::world_from_node that a mesh is drawn with.
std::size_t entry_of(const Face& face, std::uint32_t mesh) {
    const auto node = static_cast<std::size_t>(drawing_node(face, mesh));
    return face.nodes[node].skin >= 0 && !face.joints.empty() ? face.nodes.size() : node;
}

/// Weights of the point of triangle abc that is nearest to p (Ericson 2005, "Real-Time Collision Detection", 5.1.5).
glm::dvec3 nearest_on_triangle(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
    const glm::dvec3 bp = p - b;
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        const double v = d1 - d3 > 0 ? d1 / (d1 - d3) : 0;
        return {1 - v, v, 0};
    }
    const glm::dvec3 cp = p - c;
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        const double w = d2 - d6 > 0 ? d2 / (d2 - d6) : 0;
        return {1 - w, 0, w};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double along = (d4 - d3) + (d5 - d6);
        const double w = along > 0 ? (d4 - d3) / along : 0;
        return {0, 1 - w, w};
    }
    const double sum = va + vb + vc;
    return sum > 0 ? glm::dvec3(va, vb, vc) / sum : glm::dvec3(1, 0, 0);
}

}  // namespace

SurfacePoint::SurfacePoint(std::unique_ptr<AttachedPoint> made) : attached_(std::move(made)) {}
SurfacePoint::SurfacePoint(SurfacePoint&&) noexcept = default;
SurfacePoint& SurfacePoint::operator=(SurfacePoint&&) noexcept = default;
SurfacePoint::~SurfacePoint() = default;
const SurfacePlace& SurfacePoint::place() const {
    static constexpr SurfacePlace nowhere;
    return attached_ ? attached_->place : nowhere;
}

glm::dmat4 SurfaceFrame::world_from_point() const {
    const glm::dvec3 z(normal_world), x(tangent_world);
    return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x) * static_cast<double>(tangent_world.w), 0), glm::dvec4(z, 0),
            glm::dvec4(position_world, 1)};
}

Result<SurfacePoint> FaceAsset::attach(const SurfacePlace& place) const {
    const Face& its = face();
    const std::string at = its.path + ": triangle " + std::to_string(place.triangle);
    if (place.triangle >= its.indices.size() / 3) {
        return Error{at + " of a surface point does not exist; the face has " + std::to_string(its.indices.size() / 3)};
    }
    const glm::dvec3 weights(place.barycentrics);
    const double sum = weights.x + weights.y + weights.z;
    if (!finite(weights) || sum == 0) {
        return Error{at + ": the barycentrics of a surface point must be finite, and their sum not zero"};
    }
    const Primitive* primitive = drawn_primitive(its, place.triangle);
    if (primitive == nullptr) return Error{at + " of a surface point is of a mesh that no node draws"};
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) corners[c] = its.indices[std::size_t{3} * place.triangle + c];
    auto made = std::make_unique<AttachedPoint>(its, place, corners, state_->geometry);
    made->barycentrics = weights / sum;
    made->entry = entry_of(its, primitive->mesh);
    return SurfacePoint(std::move(made));
}

std::optional<SurfacePlace> FaceAsset::nearest_place(const glm::dvec3& point_face) const {
    if (!finite(point_face)) return std::nullopt;
    const Face& its = face();
    const std::vector<glm::dvec3> rest = rest_places(its, state_->skinned_origin);
    std::optional<SurfacePlace> best;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Primitive& primitive : its.primitives) {
        if (drawing_node(its, primitive.mesh) < 0) continue;
        for (std::uint32_t i = primitive.first_index; i + 2 < primitive.first_index + primitive.index_count; i += 3) {
            const glm::dvec3 &a = rest[its.indices[i]], &b = rest[its.indices[i + 1]], &c = rest[its.indices[i + 2]];
            const glm::dvec3 weights = nearest_on_triangle(point_face, a, b, c);
            const double distance = glm::distance(point_face, weights.x * a + weights.y * b + weights.z * c);
            if (!(distance < nearest)) continue;
            nearest = distance;
            best = {i / 3, glm::vec3(weights)};
        }
    }
    return best;
}

std::optional<SurfaceFrame> Character::at(const SurfacePoint& point) const {
    AttachedPoint* attached = point.attached();
    if (attached == nullptr || attached->geometry != state_->facts_of_face.geometry) return std::nullopt;
    const StanceNow& now = stance_now(*state_);
    FacePart& part = attached->part;
    part.deform(now.pose.weights, normal_method_of(*state_), now.stance.skinned_from_mesh);

    glm::dvec3 position(0), normal(0), tangent(0);
    for (std::size_t c = 0; c < 3; ++c) {
        const double weight = attached->barycentrics[static_cast<glm::length_t>(c)];
        position += weight * glm::dvec3(part.position(c));
        normal += weight * glm::dvec3(part.normal(c));
        tangent += weight * glm::dvec3(part.tangent(c));
    }
    const glm::dmat4& world = now.stance.world_from_node[attached->entry];
    const glm::dmat3 turn(world);
    const glm::dvec3 up = unit_or(normal_matrix(turn) * normal, glm::dvec3(0, 0, 1));
    const glm::dvec3 along = turn * tangent;
    const double side = glm::determinant(turn) < 0 ? -1 : 1;
    SurfaceFrame frame;
    frame.position_world = glm::dvec3(world * glm::dvec4(position, 1));
    frame.normal_world = glm::vec3(up);
    frame.tangent_world = glm::vec4(glm::vec3(unit_or(along - up * glm::dot(up, along), any_across(up))),
                                    part.tangent(0).w * static_cast<float>(side));
    return frame;
}

}  // namespace blush
