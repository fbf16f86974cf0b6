// The tables of SMAA and MLAA: laws of the areas, and the published layout.

#include "rig/antialias/smaa_tables.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rig/antialias/mlaa_table.h"
#include "rig/antialias/settings.h"

namespace blush {
namespace {

constexpr std::array crossings = {Crossing::none, Crossing::far, Crossing::near, Crossing::both};
constexpr std::array ends = {DiagonalEnd::open, DiagonalEnd::along, DiagonalEnd::across};
constexpr double exact = 1e-12;  // rounding of a few sums

Crossing upside_down(Crossing crossing) {
    if (crossing == Crossing::far) return Crossing::near;
    return crossing == Crossing::near ? Crossing::far : crossing;
}

TEST(LineAreas, OfKnownPatterns) {
    const auto areas = [](Crossing left, Crossing right, int i, int j) {
        return orthogonal_areas(left, right, i, j, 0, Smoothing::none);
    };
    // Z of one pixel: from half a pixel above to half below, two triangles of 0.5 x 0.5 / 2.
    EXPECT_DOUBLE_EQ(areas(Crossing::far, Crossing::near, 0, 0).far, 0.125);
    EXPECT_DOUBLE_EQ(areas(Crossing::far, Crossing::near, 0, 0).near, 0.125);
    // Figure 10.2: Z of eight pixels, first pixel: from 0.5 to 0.375.
    EXPECT_DOUBLE_EQ(areas(Crossing::near, Crossing::far, 0, 7).near, 0.4375);
    EXPECT_DOUBLE_EQ(areas(Crossing::near, Crossing::far, 0, 7).far, 0);
    // L of four: meets the edge after two pixels.
    EXPECT_DOUBLE_EQ(areas(Crossing::near, Crossing::none, 0, 3).near, 0.375);
    EXPECT_DOUBLE_EQ(areas(Crossing::near, Crossing::none, 1, 2).near, 0.125);
    EXPECT_DOUBLE_EQ(areas(Crossing::near, Crossing::none, 2, 1).near, 0);
    // U of one: two triangles on one side.
    EXPECT_DOUBLE_EQ(areas(Crossing::far, Crossing::far, 0, 0).far, 0.25);
    // A crossing to both sides makes a Z of the other end; alone it tells nothing.
    EXPECT_DOUBLE_EQ(areas(Crossing::both, Crossing::far, 0, 7).near, 0.4375);
    EXPECT_DOUBLE_EQ(areas(Crossing::both, Crossing::none, 0, 3).near, 0);
    EXPECT_DOUBLE_EQ(areas(Crossing::both, Crossing::both, 1, 1).near, 0);
}

TEST(LineAreas, OrthogonalPatternsAreSymmetric) {
    for (const Crossing left : crossings) {
        for (const Crossing right : crossings) {
            for (const double offset : subsample_offsets_pixels) {
                for (int i = 0; i < 12; ++i) {
                    for (int j = 0; j < 12; ++j) {
                        const auto areas = orthogonal_areas(left, right, i, j, offset, Smoothing::short_bumps);
                        const auto mirrored = orthogonal_areas(right, left, j, i, offset, Smoothing::short_bumps);
                        const auto turned = orthogonal_areas(upside_down(left), upside_down(right), i, j, -offset,
                                                             Smoothing::short_bumps);
                        EXPECT_NEAR(areas.near, mirrored.near, exact);
                        EXPECT_NEAR(areas.far, mirrored.far, exact);
                        EXPECT_NEAR(areas.near, turned.far, exact);
                        EXPECT_NEAR(areas.far, turned.near, exact);
                        EXPECT_LE(areas.near, 1);
                        EXPECT_LE(areas.far, 1);
                    }
                }
            }
        }
    }
}

TEST(LineAreas, DiagonalPatternsAreSymmetric) {
    for (const DiagonalEnd lower : ends) {
        for (const DiagonalEnd upper : ends) {
            for (const double offset : subsample_offsets_pixels) {
                for (int i = 0; i < diagonal_distances; ++i) {
                    for (int j = 0; j < diagonal_distances; ++j) {
                        const auto areas = diagonal_areas(lower, upper, i, j, offset);
                        const auto turned = diagonal_areas(upper, lower, j, i, -offset);  // by half a turn
                        EXPECT_NEAR(areas.near, turned.far, exact);
                        EXPECT_NEAR(areas.far, turned.near, exact);
                    }
                }
            }
        }
    }
}

TEST(LineAreas, OfKnownDiagonals) {
    // Without ends the line passes the middles of the edges and cuts an eighth of each pixel.
    for (const int steps : {0, 3, 19}) {
        EXPECT_NEAR(diagonal_areas(DiagonalEnd::open, DiagonalEnd::open, steps, 4, 0).near, 0.125, exact);
        EXPECT_NEAR(diagonal_areas(DiagonalEnd::open, DiagonalEnd::open, steps, 4, 0).far, 0.125, exact);
    }
    // A staircase with a longer step at both ends lies on a line from vertex to vertex: 2 up in 3 along.
    const auto slope = [](int i, int j) { return diagonal_areas(DiagonalEnd::along, DiagonalEnd::along, i, j, 0); };
    EXPECT_NEAR(slope(0, 2).far, 1 / 3.0, exact);  // first of three: from 0 to -2/3
    EXPECT_NEAR(slope(0, 2).near, 0, exact);
    EXPECT_NEAR(slope(1, 1).far, 1 / 12.0, exact);  // second: from 1/3 to -1/3
    EXPECT_NEAR(slope(1, 1).near, 1 / 12.0, exact);
    EXPECT_NEAR(slope(2, 0).near, 1 / 3.0, exact);
}

TEST(LineAreas, OffsetsAverageToThePixelCentre) {
    // Figure 10.11: what one subsample sees too high, the other sees too low. Exact where the line is straight.
    for (const double offset : {0.25, 0.125, 0.375}) {
        for (int i = 0; i < 8; ++i) {
            const auto signed_area = [&](double at) {
                const PixelAreas areas = orthogonal_areas(Crossing::far, Crossing::near, i, 7 - i, at, Smoothing::none);
                return areas.near - areas.far;
            };
            EXPECT_NEAR(signed_area(offset) + signed_area(-offset), 2 * signed_area(0), exact);
            EXPECT_NEAR(signed_area(offset) - signed_area(0), offset, exact);
            const auto diagonal = [&](double at) {
                const PixelAreas areas = diagonal_areas(DiagonalEnd::open, DiagonalEnd::open, i, 7 - i, at);
                return areas.near - areas.far;
            };
            EXPECT_NEAR(diagonal(offset) + diagonal(-offset), 2 * diagonal(0), exact);
            EXPECT_GT(diagonal(offset), diagonal(0));
        }
    }
}

TEST(SmaaTables, HoldTheAreas) {
    const SmaaAreas& areas = smaa_areas();
    ASSERT_EQ(areas.orthogonal.width, 320);
    ASSERT_EQ(areas.orthogonal.height, 2240);
    const auto byte_of = [](double area) { return static_cast<int>(std::lround(255 * area)); };
    const PixelAreas z = orthogonal_areas(Crossing::near, Crossing::far, 5, 40, 0.25, Smoothing::short_bumps);
    EXPECT_EQ(areas.orthogonal.at(64 * 3 + 5, 2 * 320 + 64 * 1 + 40).x, byte_of(z.near));
    const PixelAreas d = diagonal_areas(DiagonalEnd::along, DiagonalEnd::across, 2, 11, -0.375);
    EXPECT_EQ(areas.diagonal.at(20 * 1 + 2, 5 * 80 + 20 * 2 + 11).y, byte_of(d.far));
    for (int y = 0; y < areas.orthogonal.height; ++y) {  // the crossing code that cannot occur
        ASSERT_EQ(areas.orthogonal.at(64 * 2 + y % 64, y), glm::u8vec2(0));
    }
}

TEST(SmaaTables, ThePublishedLayoutHoldsSquaredDistances) {
    const AreaImage image = published_area_image();
    ASSERT_EQ(image.width, 160);
    ASSERT_EQ(image.height, 560);
    ASSERT_EQ(image.near_far.size(), 2U * 160 * 560);
    const SmaaAreas& areas = smaa_areas();
    for (int slice = 0; slice < subsample_slice_count; ++slice) {
        for (int code = 0; code < 25; ++code) {
            const int left = code % 5, right = code / 5;
            for (int cell = 0; cell < 64; ++cell) {  // up to 7 * 7 pixels, which both hold
                const int i = cell % 8, j = cell / 8;
                ASSERT_EQ(image.at(16 * left + i, 80 * slice + 16 * right + j),
                          areas.orthogonal.at(64 * left + i * i, 320 * slice + 64 * right + j * j));
            }
        }
        for (int y = 0; y < 80; ++y) {
            for (int x = 0; x < 80; ++x)
                ASSERT_EQ(image.at(80 + x, 80 * slice + y), areas.diagonal.at(x, 80 * slice + y));
        }
    }
}

TEST(SmaaTables, ThePublishedLayoutIsCoarser) {
    // Read as published shaders do, by bilinear interpolation at the square roots of the distances.
    const AreaImage image = published_area_image();
    double worst = 0;
    for (const Crossing left : crossings) {
        for (const Crossing right : crossings) {
            for (int d1 = 0; d1 < orthogonal_distances; ++d1) {
                for (int d2 = 0; d2 < orthogonal_distances; ++d2) {
                    const double u = std::sqrt(d1), v = std::sqrt(d2);
                    const int i = static_cast<int>(u), j = static_cast<int>(v);
                    const auto near = [&](int x, int y) {
                        return static_cast<double>(image
                                                       .at(16 * static_cast<int>(left) + std::min(i + x, 15),
                                                           16 * static_cast<int>(right) + std::min(j + y, 15))
                                                       .x);
                    };
                    const double read = glm::mix(glm::mix(near(0, 0), near(1, 0), u - i),
                                                 glm::mix(near(0, 1), near(1, 1), u - i), v - j) /
                                        255;
                    const double truth = orthogonal_areas(left, right, d1, d2, 0, Smoothing::short_bumps).near;
                    worst = std::max(worst, std::abs(read - truth));
                }
            }
        }
    }
    EXPECT_NEAR(worst, 0.103, 0.002);  // why the filter reads whole distances: see smaa_tables.h
}

TEST(SmaaTables, TheSearchTableDecodesEveryFetch) {
    // The sixteen patterns of four edges, each weighed as the bilinear fetch weighs them: no two sums are alike, and
    // the table says how far each reaches.
    const auto& table = search_table();
    ASSERT_EQ(table.size(), 64U * 16);
    std::array<int, 33> seen{};
    for (int near = 0; near < 2; ++near) {
        for (int far = 0; far < 2; ++far) {
            for (int above = 0; above < 4; ++above) {
                const int edges = 21 * near + 7 * far + 3 * (above & 1) + (above >> 1);
                ++seen[static_cast<std::size_t>(edges)];
                for (int crossing = 0; crossing <= 32; ++crossing) {
                    for (const int side : {0, search_table_right}) {
                        if (crossing + side >= 64 || 32 - edges >= 16) continue;
                        const int length = table[static_cast<std::size_t>(64 * (32 - edges) + crossing + side)] / 127;
                        if (crossing == 0) {
                            EXPECT_EQ(length, near == 0 ? 0 : 1 + far) << edges;
                        } else {
                            EXPECT_LE(length, near == 0 ? 0 : 1 + far) << edges;
                        }
                    }
                }
            }
        }
    }
    for (const int count : seen) EXPECT_LE(count, 1);
    // A crossing edge at the near boundary: a search to the right stops before it, one to the left behind its pixel.
    EXPECT_EQ(last_step_length(true, true, true, true, false), 0);
    EXPECT_EQ(last_step_length(false, true, true, true, false), 1);
    EXPECT_EQ(last_step_length(true, true, true, false, true), 1);
    EXPECT_EQ(last_step_length(false, true, true, false, true), 2);
}

TEST(MlaaTable, IsThatOfFigure92) {
    const AreaImage& areas = mlaa_areas();
    ASSERT_EQ(areas.width, 45);
    ASSERT_EQ(areas.height, 45);
    EXPECT_EQ(areas.at(9 * 3 + 0, 9 * 1 + 7).x, std::lround(255 * 0.4375));  // Z of eight
    EXPECT_EQ(areas.at(9 * 1, 9 * 1).y, std::lround(255 * 0.25));            // U of one, not smoothed
    for (int k = 0; k < 45; ++k) {
        for (int code = 18; code < 27; ++code) {
            EXPECT_EQ(areas.at(code, k), glm::u8vec2(0));
            EXPECT_EQ(areas.at(k, code), glm::u8vec2(0));
        }
    }
}

TEST(SubsampleSlices, AreThoseAcrossTheLine) {
    const auto offsets = [](glm::vec2 jitter) {
        const SubsampleSlices slices = subsample_slices(jitter);
        std::array<double, 4> found{};
        for (glm::length_t i = 0; i < 4; ++i)
            found[static_cast<std::size_t>(i)] = subsample_offsets_pixels[static_cast<std::size_t>(slices[i])];
        return found;
    };
    EXPECT_EQ(offsets({0, 0}), (std::array<double, 4>{0, 0, 0, 0}));
    // x and y to opposite sides: along the diagonal to the upper right, so that it does not move; across the other.
    EXPECT_EQ(offsets({0.25F, -0.25F}), (std::array<double, 4>{-0.25, 0.25, 0, -0.25}));
    EXPECT_EQ(offsets({-0.25F, 0.25F}), (std::array<double, 4>{0.25, -0.25, 0, 0.25}));
    EXPECT_EQ(offsets({0.125F, 0.375F}), (std::array<double, 4>{0.375, 0.125, 0.25, 0.125}));
}

}  // namespace
}  // namespace blush
