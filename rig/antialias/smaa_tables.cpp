#include "rig/antialias/smaa_tables.h"

#include <algorithm>
#include <cmath>

namespace blush {
namespace {

AreaImage blank(int width, int height) {
    return {width, height,
            std::vector<std::uint8_t>(2 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
}

std::uint8_t byte_of(double area) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(area, 0.0, 1.0))); }

void write(AreaImage& image, int x, int y, const PixelAreas& areas) {
    const auto i =
        2 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
    image.near_far[i] = byte_of(areas.near);
    image.near_far[i + 1] = byte_of(areas.far);
}

struct Place {
    int x = 0, y = 0;  ///< of the slice's first texel
    int block = 0;     ///< side, texels
};

/// distance(i): the distance that index i of a block stands for.
template <class Distance>
void write_orthogonal(AreaImage& image, Place place, double offset, Distance distance) {
    constexpr std::array crossings = {Crossing::none, Crossing::far, Crossing::near, Crossing::both};
    for (const Crossing left : crossings) {
        for (const Crossing right : crossings) {
            const int x = place.x + place.block * static_cast<int>(left);
            const int y = place.y + place.block * static_cast<int>(right);
            for (int j = 0; j < place.block; ++j) {
                for (int i = 0; i < place.block; ++i) {
                    write(image, x + i, y + j,
                          orthogonal_areas(left, right, distance(i), distance(j), offset, Smoothing::short_bumps));
                }
            }
        }
    }
}

void write_diagonal(AreaImage& image, int slice_x, int slice_y, double offset) {
    // A fourth code, for ends that go on both ways, cannot occur: a search follows the staircase while it can.
    constexpr std::array ends = {DiagonalEnd::open, DiagonalEnd::along, DiagonalEnd::across};
    for (const DiagonalEnd lower : ends) {
        for (const DiagonalEnd upper : ends) {
            const int x = slice_x + diagonal_distances * static_cast<int>(lower);
            const int y = slice_y + diagonal_distances * static_cast<int>(upper);
            for (int j = 0; j < diagonal_distances; ++j) {
                for (int i = 0; i < diagonal_distances; ++i) {
                    write(image, x + i, y + j, diagonal_areas(lower, upper, i, j, offset));
                }
            }
        }
    }
}

SmaaAreas compute_areas() {
    SmaaAreas areas{blank(orthogonal_slice_side, orthogonal_slice_side * subsample_slice_count),
                    blank(diagonal_slice_side, diagonal_slice_side * subsample_slice_count)};
    for (int slice = 0; slice < subsample_slice_count; ++slice) {
        const double offset = subsample_offsets_pixels[static_cast<std::size_t>(slice)];
        write_orthogonal(areas.orthogonal, {0, slice * orthogonal_slice_side, orthogonal_distances}, offset,
                         [](int i) { return i; });
        write_diagonal(areas.diagonal, 0, slice * diagonal_slice_side, offset);
    }
    return areas;
}

/// Bilinear weights of a fetch a quarter and an eighth of a pixel off the centre of the pixel `near` in this row
/// (eq. 10.5 with x = 0.25 and y = x / 2): near and far of this row, near and far of the row above, in 32nds. Any sum
/// of them tells its terms.
constexpr std::array<int, 4> fetch_weights = {21, 7, 3, 1};

std::vector<std::uint8_t> compute_search_table() {
    std::vector<std::uint8_t> table(search_table_width * search_table_height);
    for (unsigned edges = 0; edges < 16; ++edges) {
        for (unsigned crossings = 0; crossings < 16; ++crossings) {
            int edge_sum = 0, crossing_sum = 0;
            for (unsigned b = 0; b < 4; ++b) {
                edge_sum += (edges >> b & 1U) != 0 ? fetch_weights[b] : 0;
                crossing_sum += (crossings >> b & 1U) != 0 ? fetch_weights[b] : 0;
            }
            for (const bool to_the_right : {false, true}) {
                const int length = last_step_length(to_the_right, (edges & 1U) != 0, (edges & 2U) != 0,
                                                    (crossings & 5U) != 0, (crossings & 10U) != 0);
                const int x = crossing_sum + (to_the_right ? search_table_right : 0), y = 32 - edge_sum;
                if (x >= search_table_width || y >= search_table_height) continue;  // all 0 there
                table[static_cast<std::size_t>(y * search_table_width + x)] = static_cast<std::uint8_t>(127 * length);
            }
        }
    }
    return table;
}

}  // namespace

int last_step_length(bool to_the_right, bool edge_near, bool edge_far, bool crossing_near, bool crossing_far) {
    if (to_the_right) {  // the boundary comes before its pixel
        if (crossing_near || !edge_near) return 0;
        return crossing_far || !edge_far ? 1 : 2;
    }
    if (!edge_near) return 0;
    return crossing_near || !edge_far ? 1 : 2;
}

const SmaaAreas& smaa_areas() {
    static const SmaaAreas areas = compute_areas();
    return areas;
}

AreaImage published_area_image() {
    constexpr int side = 80, block = 16;
    AreaImage image = blank(2 * side, side * subsample_slice_count);
    for (int slice = 0; slice < subsample_slice_count; ++slice) {
        const double offset = subsample_offsets_pixels[static_cast<std::size_t>(slice)];
        write_orthogonal(image, {0, slice * side, block}, offset, [](int i) { return i * i; });
        write_diagonal(image, side, slice * side, offset);
    }
    return image;
}

const std::vector<std::uint8_t>& search_table() {
    static const std::vector<std::uint8_t> table = compute_search_table();
    return table;
}

}  // namespace blush
