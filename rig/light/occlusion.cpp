#include "rig/light/occlusion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace blush {
namespace {

constexpr double pi = std::numbers::pi;

/// FNV-1a, 64 bits.
class Hash {
public:
    void add(std::uint32_t word) {
        for (int shift = 0; shift < 32; shift += 8) value_ = (value_ ^ (word >> shift & 0xffU)) * 0x100000001b3ULL;
    }
    void add(float number) { add(std::bit_cast<std::uint32_t>(number == 0 ? 0.0F : number)); }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace

std::uint64_t occlusion_identity(const Face& face) {
    Hash hash;
    for (const glm::vec3& position : face.positions) {
        for (glm::length_t c = 0; c < 3; ++c) hash.add(position[c]);
    }
    for (const std::uint32_t index : face.indices) hash.add(index);
    for (const Primitive& primitive : face.primitives) hash.add(stops_light(face, primitive) ? 1U : 0U);
    return hash.value();
}

bool stops_light(const Face& face, const Primitive& primitive) {
    return primitive.material < 0 ||
           face.materials[static_cast<std::size_t>(primitive.material)].alpha_mode == AlphaMode::opaque;
}

glm::dmat3 vertex_frame(glm::dvec3 normal, glm::dvec3 tangent) {
    glm::dvec3 x = tangent - normal * glm::dot(normal, tangent);
    if (!(glm::dot(x, x) > 1e-12)) {
        const glm::dvec3 other = std::abs(normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        x = other - normal * glm::dot(normal, other);
    }
    x = glm::normalize(x);
    return {x, glm::cross(normal, x), normal};
}

std::vector<glm::dvec3> cosine_directions(std::uint32_t count) {
    std::vector<glm::dvec3> directions;
    directions.reserve(count);
    const double turn = pi * (3 - std::sqrt(5.0));  // the golden angle
    for (std::uint32_t i = 0; i < count; ++i) {
        const double u = (i + 0.5) / count, r = std::sqrt(u);
        directions.emplace_back(r * std::cos(turn * i), r * std::sin(turn * i), std::sqrt(1 - u));
    }
    return directions;
}

LightTransfer transfer_of(std::span<const glm::dvec3> directions, std::span<const std::uint8_t> hidden) {
    Sh9 sum = clamped_cosine({0, 0, 1});
    const double share = pi / static_cast<double>(directions.size());
    for (std::size_t d = 0; d < directions.size(); ++d) {
        if (hidden[d] == 0) continue;
        const Sh9 basis = sh_basis(directions[d]);
        for (std::size_t i = 0; i < 9; ++i) sum[i] -= share * basis[i];
    }
    LightTransfer transfer{};
    for (std::size_t i = 0; i < 9; ++i) transfer[i] = static_cast<float>(sum[i]);
    return transfer;
}

double openness(const LightTransfer& transfer) {
    // Coefficient 0 is the integral of cosine times visibility, times a constant.
    return std::clamp(static_cast<double>(transfer[0]) / (sh_basis({0, 0, 1})[0] * pi), 0.0, 1.0);
}

glm::dvec3 occluded_ambient(const Sh9Color& radiance, const LightTransfer& transfer, const glm::dmat3& world_from_frame,
                            glm::dvec3 least_radiance) {
    Sh9 local{};
    std::ranges::copy(transfer, local.begin());
    const glm::dvec3 gathered = dot(radiance, rotate(sh_rotation(world_from_frame), local)) / pi;
    const glm::dvec3 open = glm::max(dot(radiance, clamped_cosine(world_from_frame[2])) / pi, glm::dvec3(0));
    return glm::min(glm::max(gathered, openness(transfer) * least_radiance), open);
}

glm::dvec3 with_bounces(glm::dvec3 direct, double openness, glm::dvec3 albedo) {
    return direct / glm::max(1.0 - albedo * (1 - openness), glm::dvec3(1e-3));
}

void fill_shut_vertices(std::span<const std::uint32_t> triangles, std::vector<LightTransfer>& transfers) {
    constexpr double shut_below = 0.02;
    constexpr int rings = 3;
    std::vector<std::uint8_t> shut;
    for (const LightTransfer& transfer : transfers) shut.push_back(openness(transfer) < shut_below ? 1 : 0);
    for (int ring = 0; ring < rings; ++ring) {
        std::vector<LightTransfer> sum(transfers.size(), LightTransfer{});
        std::vector<float> count(transfers.size(), 0.0F);
        for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
            for (std::size_t a = 0; a < 3; ++a) {
                for (std::size_t b = 0; b < 3; ++b) {
                    const std::uint32_t to = triangles[i + a], from = triangles[i + b];
                    if (shut[to] == 0 || shut[from] != 0) continue;
                    for (std::size_t k = 0; k < 9; ++k) sum[to][k] += transfers[from][k];
                    ++count[to];
                }
            }
        }
        for (std::size_t v = 0; v < transfers.size(); ++v) {
            if (count[v] == 0) continue;
            for (std::size_t k = 0; k < 9; ++k) transfers[v][k] = sum[v][k] / count[v];
            shut[v] = 0;
        }
    }
}

void occlusion_weights(const OcclusionSet& set, const Face& face, std::span<const float> weights,
                       std::span<float> out) {
    std::ranges::fill(out, 0.0F);
    float rest = 1;
    for (std::size_t p = 1; p < set.poses.size(); ++p) {
        const auto target = std::ranges::find(face.targets, set.poses[p].target, &Target::name);
        if (target == face.targets.end()) continue;
        const float weight = weights[static_cast<std::size_t>(target - face.targets.begin())];
        out[p] = std::isfinite(weight) ? std::clamp(weight, 0.0F, 1.0F) : 0.0F;
        rest -= out[p];
    }
    out[0] = rest;
}

}  // namespace blush
