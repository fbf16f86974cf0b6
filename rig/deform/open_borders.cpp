#include "rig/deform/open_borders.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace blush {

std::vector<std::uint32_t> places_of_meshes(const Face& face) {
    std::vector<std::uint32_t> mesh(face.positions.size(), 0);
    for (const Primitive& primitive : face.primitives)
        std::fill_n(mesh.begin() + primitive.first_vertex, primitive.vertex_count, primitive.mesh);
    std::vector<std::uint32_t> order(face.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t v) {
        const glm::vec3 p = face.positions[v];
        return std::tuple(mesh[v], p.x, p.y, p.z);
    };
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return std::tuple_cat(key(a), std::tuple(a)) < std::tuple_cat(key(b), std::tuple(b));
    });
    std::vector<std::uint32_t> place(face.positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        place[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? place[order[i - 1]] : order[i];
    }
    return place;
}

std::vector<OpenBorder> open_borders(const Face& face, std::span<const std::uint8_t> taken,
                                     std::span<const glm::dvec3> places) {
    const std::vector<std::uint32_t> place = places_of_meshes(face);
    // How often each edge is there, and which way round the last time.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, bool>> edges;
    for (std::size_t p = 0; p < face.primitives.size(); ++p) {
        if (taken[p] == 0) continue;
        const Primitive& primitive = face.primitives[p];
        for (std::uint32_t i = primitive.first_index; i + 2 < primitive.first_index + primitive.index_count; i += 3) {
            for (std::uint32_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t a = place[face.indices[i + corner]], b = place[face.indices[i + (corner + 1) % 3]];
                if (a == b) continue;
                auto& [count, forward] = edges[{std::min(a, b), std::max(a, b)}];
                ++count;
                forward = a < b;
            }
        }
    }
    std::multimap<std::uint32_t, std::uint32_t> next;
    for (const auto& [ends, how] : edges) {
        if (how.first != 1) continue;
        next.emplace(how.second ? ends.first : ends.second, how.second ? ends.second : ends.first);
    }
    std::vector<OpenBorder> borders;
    while (!next.empty()) {
        OpenBorder border;
        const std::uint32_t start = next.begin()->first;
        std::uint32_t at = start;
        bool closed = false;
        while (!closed) {
            const auto edge = next.find(at);
            if (edge == next.end()) break;
            border.vertices.push_back(at);
            const double length = glm::distance(places[at], places[edge->second]);
            border.length += length;
            border.middle += 0.5 * length * (places[at] + places[edge->second]);
            at = edge->second;
            next.erase(edge);
            closed = at == start;
        }
        if (!closed || !(border.length > 0)) continue;
        border.middle /= border.length;
        borders.push_back(std::move(border));
    }
    return borders;
}

std::vector<std::uint32_t> neck_border(const Face& face, std::span<const std::uint8_t> taken,
                                       std::span<const glm::dvec3> places) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (std::size_t p = 0; p < face.primitives.size(); ++p) {
        if (taken[p] == 0) continue;
        for (const glm::dvec3& place :
             places.subspan(face.primitives[p].first_vertex, face.primitives[p].vertex_count)) {
            low = std::min(low, place.y);
            high = std::max(high, place.y);
        }
    }
    std::vector<OpenBorder> borders = open_borders(face, taken, places);
    std::erase_if(borders, [&](const OpenBorder& border) {
        return std::ranges::none_of(border.vertices,
                                    [&](std::uint32_t v) { return places[v].y <= low + 0.1 * (high - low); });
    });
    double longest = 0;
    for (const OpenBorder& border : borders) longest = std::max(longest, border.length);
    const OpenBorder* lowest = nullptr;
    for (const OpenBorder& border : borders) {
        if (border.length < 0.5 * longest) continue;
        if (lowest == nullptr || border.middle.y < lowest->middle.y) lowest = &border;
    }
    return lowest == nullptr ? std::vector<std::uint32_t>() : lowest->vertices;
}

}  // namespace blush
