#pragma once
/// The head's skin as its texture sees it: for every texel, the place on the rest head that it is glued to.

#include <cstdint>
#include <span>

#include "tools/make_face/head_mesh.h"
#include "tools/make_face/parallel.h"

namespace blush::make_face {

struct SurfaceTexel {
    glm::vec3 p{0}, normal{0};  ///< on the rest head, millimetres; unit
    float depth = 0;            ///< as VertexTag
    Part part = Part::skin;
    std::int8_t lip = 0;
    bool covered = false;  ///< by a triangle, or within a texel of one

    Vec3 place() const { return Vec3(p); }
    /// The place on the left half.
    Vec3 half() const { return {std::abs(static_cast<double>(p.x)), p.y, p.z}; }
};

class SurfaceTexels {
public:
    SurfaceTexels(const Head& head, int side);

    int side() const { return side_; }
    const SurfaceTexel& at(int x, int y) const { return texels_[index(x, y)]; }

    /// `paint(x, y, texel, k)` for every covered texel, k its index in rows from the top; each once, in any order.
    template <class Paint>
    void for_each(Paint paint) const {
        parallel_pieces(side_, [&](int first_row, int last_row) {
            for (int y = first_row; y < last_row; ++y) {
                for (int x = 0; x < side_; ++x) {
                    const std::size_t k = index(x, y);
                    if (texels_[k].covered) paint(x, y, texels_[k], k);
                }
            }
        });
    }

    /// Gives bare texels near a chart the value of the covered one next to them, so that filtering and the first mip
    /// levels do not show the charts' edges. `values`: `channels` for each texel.
    template <class Value>
    void fill_margins(std::span<Value> values, int channels) const {
        const auto width = static_cast<std::size_t>(channels);
        for (const auto& [to, from] : margins_) std::copy_n(&values[from * width], width, &values[to * width]);
    }

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x);
    }
    void rasterise(const Head& head, int first_row, int last_row);
    void find_margins();

    int side_;
    std::vector<SurfaceTexel> texels_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> margins_;  ///< (bare texel, the one whose value it takes)
};

}  // namespace blush::make_face
