#include "tools/make_face/surface_texels.h"

#include <limits>

namespace blush::make_face {

SurfaceTexels::SurfaceTexels(const Head& head, int side)
    : side_(side), texels_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {
    parallel_pieces(side, [&](int first_row, int last_row) { rasterise(head, first_row, last_row); });
    find_margins();
}

void SurfaceTexels::rasterise(const Head& head, int first_row, int last_row) {
    const Mesh& mesh = head.mesh;
    // A texel whose middle no triangle covers belongs to the one that it misses by least.
    std::vector<double> inside(static_cast<std::size_t>(last_row - first_row) * static_cast<std::size_t>(side_),
                               -std::numeric_limits<double>::infinity());
    constexpr double past_edge_texels = 0.75;
    for (const Triangle& t : mesh.triangles) {
        const auto corner = [&](std::size_t c) { return mesh.uv[t[c]] * static_cast<double>(side_); };
        const Vec2 a = corner(0), b = corner(1), c = corner(2);
        const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        if (std::abs(area) < 1e-9) continue;
        const Vec3 height = std::abs(area) / glm::max(Vec3(glm::length(c - b), glm::length(a - c), glm::length(b - a)),
                                                      Vec3(1e-9));  // of the triangle over each side, texels
        const auto low = [](double x, double y, double z) {
            return static_cast<int>(std::floor(std::min({x, y, z}) - 1));
        };
        const auto high = [](double x, double y, double z) {
            return static_cast<int>(std::ceil(std::max({x, y, z}) + 1));
        };
        Part part = Part::skin;
        std::int8_t lip = 0;
        for (const Index v : t) {
            if (head.tags[v].part != Part::skin) part = head.tags[v].part;
            if (head.tags[v].lip != 0) lip = static_cast<std::int8_t>(head.tags[v].lip);
        }
        for (int y = std::max(first_row, low(a.y, b.y, c.y)); y <= std::min(last_row - 1, high(a.y, b.y, c.y)); ++y) {
            for (int x = std::max(0, low(a.x, b.x, c.x)); x <= std::min(side_ - 1, high(a.x, b.x, c.x)); ++x) {
                const Vec2 q(x + 0.5, y + 0.5);
                Vec3 w;
                w.x = ((b.x - q.x) * (c.y - q.y) - (c.x - q.x) * (b.y - q.y)) / area;
                w.y = ((c.x - q.x) * (a.y - q.y) - (a.x - q.x) * (c.y - q.y)) / area;
                w.z = 1 - w.x - w.y;
                const Vec3 texels = w * height;  // distance to each side, positive inside
                const double least = std::min({texels.x, texels.y, texels.z});
                if (least < -past_edge_texels) continue;
                double& best = inside[static_cast<std::size_t>(y - first_row) * static_cast<std::size_t>(side_) +
                                      static_cast<std::size_t>(x)];
                if (std::min(least, 0.0) <= best) continue;
                best = std::min(least, 0.0);
                SurfaceTexel& texel = texels_[index(x, y)];
                const auto mixed = [&](const std::vector<Vec3>& v) {
                    return v[t[0]] * w.x + v[t[1]] * w.y + v[t[2]] * w.z;
                };
                texel.p = glm::vec3(mixed(mesh.positions));
                texel.normal = glm::vec3(glm::normalize(mixed(mesh.normals)));
                texel.depth = static_cast<float>(head.tags[t[0]].depth * w.x + head.tags[t[1]].depth * w.y +
                                                 head.tags[t[2]].depth * w.z);
                texel.part = part;
                texel.lip = lip;
                texel.covered = true;
            }
        }
    }
}

void SurfaceTexels::find_margins() {
    constexpr int rings = 8;  // the third mip level's texel is as wide
    std::vector<char> known(texels_.size());
    std::vector<std::uint32_t> rim;
    for (std::size_t k = 0; k < texels_.size(); ++k) {
        known[k] = texels_[k].covered ? 1 : 0;
        if (known[k]) rim.push_back(static_cast<std::uint32_t>(k));
    }
    for (int ring = 0; ring < rings; ++ring) {
        std::vector<std::uint32_t> next;
        for (const std::uint32_t k : rim) {
            const int x = static_cast<int>(k) % side_, y = static_cast<int>(k) / side_;
            for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
                const int nx = x + step.x, ny = y + step.y;
                if (nx < 0 || nx >= side_ || ny < 0 || ny >= side_ || known[index(nx, ny)]) continue;
                known[index(nx, ny)] = 1;
                next.push_back(static_cast<std::uint32_t>(index(nx, ny)));
                margins_.emplace_back(next.back(), k);
            }
        }
        rim.swap(next);
    }
}

}  // namespace blush::make_face
