#include "rig/deform/pinning.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

#include "rig/deform/open_borders.h"
#include "rig/deform/surface_normals.h"

namespace blush {
namespace {

/// Shortest way along edges from any of `sources` to each place that is nearer than `width`; infinite elsewhere.
std::vector<double> distances(const Face& face, const std::vector<std::uint32_t>& place,
                              std::span<const glm::dvec3> places, std::span<const std::uint32_t> sources,
                              double width) {
    std::vector<std::vector<std::uint32_t>> neighbours(place.size());
    for (std::size_t i = 0; i + 2 < face.indices.size(); i += 3) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t a = place[face.indices[i + corner]], b = place[face.indices[i + (corner + 1) % 3]];
            neighbours[a].push_back(b);
            neighbours[b].push_back(a);
        }
    }
    std::vector<double> distance(place.size(), std::numeric_limits<double>::infinity());
    using Reached = std::pair<double, std::uint32_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
    for (const std::uint32_t source : sources) {
        distance[place[source]] = 0;
        front.emplace(0, place[source]);
    }
    while (!front.empty()) {
        const auto [so_far, at] = front.top();
        front.pop();
        if (so_far > distance[at]) continue;
        for (const std::uint32_t next : neighbours[at]) {
            const double there = so_far + glm::distance(places[at], places[next]);
            if (!(there < width) || there >= distance[next]) continue;
            distance[next] = there;
            front.emplace(there, next);
        }
    }
    return distance;
}

/// Weights of the nearest pins among `candidates`, whose places are `of_pin`.
void follow(glm::dvec3 place, std::span<const glm::dvec3> of_pin, std::span<const std::uint32_t> candidates,
            PinnedVertex& entry) {
    constexpr std::size_t looked_at = pins_a_vertex + 1;
    std::array<std::pair<double, std::uint32_t>, looked_at> nearest;
    nearest.fill({std::numeric_limits<double>::infinity(), 0});
    for (const std::uint32_t pin : candidates) {
        const std::pair<double, std::uint32_t> one{glm::distance(place, of_pin[pin]), pin};
        if (one >= nearest.back()) continue;
        nearest.back() = one;
        std::ranges::sort(nearest);
    }
    // The first one beyond sets the scale, and has no share itself.
    const double reach = nearest.back().first;
    std::array<double, pins_a_vertex> share{};
    double sum = 0;
    for (std::size_t k = 0; k < pins_a_vertex; ++k) {
        const auto& [distance, pin] = nearest[k];
        if (distance == std::numeric_limits<double>::infinity()) continue;
        const double inverse = 1 / std::max(distance, 1e-12);
        const double less = reach == std::numeric_limits<double>::infinity() ? 0 : 1 / std::max(reach, 1e-12);
        share[k] = (inverse - less) * (inverse - less);
        entry.pin[k] = pin;
        sum += share[k];
    }
    if (!(sum > 0)) {  // five at one distance
        share = {1, 0, 0, 0};
        sum = 1;
    }
    for (std::size_t k = 0; k < pins_a_vertex; ++k) entry.weight[k] = static_cast<float>(share[k] / sum);
}

}  // namespace

std::vector<PinnedVertex> pin_ring(const Face& face, std::span<const glm::dvec3> places,
                                   std::span<const std::uint32_t> vertices, double width) {
    const std::vector<std::uint32_t> place = places_of_meshes(face);
    const std::vector<double> distance = distances(face, place, places, vertices, width);
    std::vector<std::uint32_t> mesh_of(place.size(), 0);
    for (const Primitive& primitive : face.primitives)
        std::fill_n(mesh_of.begin() + primitive.first_vertex, primitive.vertex_count, primitive.mesh);
    std::vector<std::uint32_t> pin_at(place.size(), no_vertex);  // of each place
    std::vector<std::vector<std::uint32_t>> pins_of_mesh(face.meshes.size());
    std::vector<glm::dvec3> of_pin;
    for (std::uint32_t pin = 0; pin < vertices.size(); ++pin) {
        pin_at[place[vertices[pin]]] = pin;
        pins_of_mesh[mesh_of[vertices[pin]]].push_back(pin);
        of_pin.push_back(places[vertices[pin]]);
    }
    std::vector<PinnedVertex> ring;
    for (std::uint32_t v = 0; v < place.size(); ++v) {
        const double far = distance[place[v]];
        if (far == std::numeric_limits<double>::infinity()) continue;
        PinnedVertex entry;
        entry.vertex = v;
        if (pin_at[place[v]] != no_vertex) {
            entry.influence = 1;
            entry.pin[0] = pin_at[place[v]];
            entry.weight[0] = 1;
        } else {
            const double t = far / width;
            // Below 1, so that only what is at a pin is taken for that.
            entry.influence = std::min(static_cast<float>((1 - t) * (1 - t) * (1 + 2 * t)), 0.999999F);
            follow(places[v], of_pin, pins_of_mesh[mesh_of[v]], entry);
            if (!(entry.influence > 0)) continue;
        }
        ring.push_back(entry);
    }
    return ring;
}

void apply_pins(std::span<const PinnedVertex> ring, std::span<const Pin> pins, const PinnedAttributes& surface) {
    for (const PinnedVertex& entry : ring) {
        const std::uint32_t v = entry.vertex;
        const glm::vec3 normal = surface.from_normals[v];
        glm::vec3 pinned_normal = normal;
        if (entry.influence == 1) {
            const Pin& pin = pins[entry.pin[0]];
            if (pin.vertex == no_vertex) continue;
            surface.positions[v] = pin.position;
            pinned_normal = pin.normal;
        } else {
            glm::vec3 move(0), turn(0);
            for (std::size_t k = 0; k < pins_a_vertex; ++k) {
                const Pin& pin = pins[entry.pin[k]];
                if (entry.weight[k] == 0 || pin.vertex == no_vertex) continue;
                move += entry.weight[k] * (pin.position - surface.from_positions[pin.vertex]);
                turn += entry.weight[k] * (pin.normal - surface.from_normals[pin.vertex]);
            }
            if (move == glm::vec3(0) && turn == glm::vec3(0)) continue;
            surface.positions[v] = surface.from_positions[v] + entry.influence * move;
            if (turn != glm::vec3(0)) pinned_normal = normalized_or(normal + entry.influence * turn, normal);
        }
        if (pinned_normal == normal) continue;  // what does not turn keeps its bits
        surface.normals[v] = pinned_normal;
        surface.tangents[v] = orthogonal_tangent(surface.tangents[v], pinned_normal, surface.tangents[v]);
    }
}

}  // namespace blush
