#pragma once
/// Small pictures that antialiasing must cope with, made by code: patterns, text, gradients, noise.

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "rig/antialias/pixels.h"

namespace blush::test {

struct NamedPicture {
    std::string name;
    Pixels pixels;
};

/// Rows of text, '#' white on black, each letter a pixel; what is not '#' or '.' ends nothing.
inline Pixels drawn(const std::vector<std::string>& rows, glm::vec4 ink = glm::vec4(1),
                    glm::vec4 paper = glm::vec4(0, 0, 0, 1)) {
    Pixels picture(static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), paper);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#') picture.at(x, y) = ink;
        }
    }
    return picture;
}

/// One of the eight ways to turn and mirror a picture: bit 0 exchanges left and right, bit 1 top and bottom, bit 2 x
/// and y (after the other two).
template <class Cells>
Cells turned(const Cells& picture, unsigned way) {
    const bool transpose = (way & 4U) != 0;
    Cells out(transpose ? picture.height : picture.width, transpose ? picture.width : picture.height);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const int to_x = (way & 1U) != 0 ? picture.width - 1 - x : x;
            const int to_y = (way & 2U) != 0 ? picture.height - 1 - y : y;
            (transpose ? out.at(to_y, to_x) : out.at(to_x, to_y)) = picture.at(x, y);
        }
    }
    return out;
}

/// The orthogonal patterns (jimenez-2012, figures 9.4 and 10.3): a line of `length` edges in the middle, at whose ends
/// the contour leaves upwards (-1), downwards (1), both ways (2: what is beyond is the other way round) or not at all
/// (0: it runs on to the border). arm: length of the crossing edges, pixels.
inline Pixels orthogonal_pattern(int left_side, int right_side, int length, int arm) {
    const int margin = 6, height = 16, width = length + 2 * margin, middle = height / 2;
    Pixels picture(width, height, {0, 0, 0, 1});
    for (int x = 0; x < width; ++x) {
        const int side = x < margin ? left_side : x >= margin + length ? right_side : 0;
        const int first = side == 2 ? middle : middle + side * arm;
        for (int y = 0; y < height; ++y) {
            const bool inverted = side == 2 && std::abs(2 * (y - middle) + 1) < 2 * arm;
            if ((y >= first) != inverted) picture.at(x, y) = glm::vec4(1);
        }
    }
    return picture;
}

/// The diagonal patterns: `steps` steps of one pixel to the upper right, before and after which the contour goes on
/// along a row (true) or a column.
inline Pixels diagonal_pattern(bool starts_along_row, bool ends_along_row, int steps) {
    const int side = steps + 12;
    Pixels picture(side, side, {0, 0, 0, 1});
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            // Steps on the line x + y = side - 1, between columns 6 and side - 6.
            int first = side - 1 - x;
            if (x < 6) first = starts_along_row ? side - 1 - 6 : side;
            if (x >= side - 6) first = ends_along_row ? 6 : 0;
            if (y >= first) picture.at(x, y) = glm::vec4(1);
        }
    }
    return picture;
}

/// Letters of 5 x 7 pixels, drawn for these tests.
inline Pixels text_picture(glm::vec4 ink, glm::vec4 paper) {
    return drawn({"..............................................", "..#...####...###..#...#.####..###.#####.#...#.",
                  ".#.#..#...#.#...#.##..#..#...#...#...#...#.#..", "#...#.####..#.....#.#.#..#...#.......#....#...",
                  "#####.#...#.#.....#..##..#...#..##..#....#.#..", "#...#.#...#.#...#.#...#..#...#...#.#....#...#.",
                  "#...#.####...###..#...#.###...###.#####.#...#.", "..............................................",
                  "..###....##...#.#...#.....#.......#####.......", ".#...#..#.#...#.#..#.#...#.#..###.#...#..#.#..",
                  ".#...#.#..#..#####..#...#...#.....#.#.#.#.#.#.", "..####.#####...#.#.....#..#..##...#...#..#.#..",
                  ".....#....#..#####.#..#....#......#####.......", "..###.....#...#.#...##.#...##.................",
                  ".............................................."},
                 ink, paper);
}

inline Pixels noise_picture(int width, int height, unsigned seed, int levels, bool gray) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> level(0, levels - 1);
    Pixels picture(width, height);
    for (glm::vec4& texel : picture.cells) {
        const auto next = [&] { return static_cast<float>(level(random) * (255 / (levels - 1))) / 255.0F; };
        const float r = next();
        texel = gray ? glm::vec4(r, r, r, 1) : glm::vec4(r, next(), next(), 1);
    }
    return picture;
}

inline Pixels painted(int width, int height, const std::function<glm::vec4(int, int)>& color) {
    Pixels picture(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec4 c = color(x, y) * 255.0F;
            picture.at(x, y) = glm::vec4(std::round(c.x), std::round(c.y), std::round(c.z), std::round(c.w)) / 255.0F;
        }
    }
    return picture;
}

/// Over a hundred pictures of 8-bit colours.
inline std::vector<NamedPicture> antialias_pictures() {
    std::vector<NamedPicture> all;
    const auto add = [&](const std::string& name, const Pixels& picture) { all.push_back({name, picture}); };
    for (const int left : {-1, 0, 1, 2}) {
        for (const int right : {-1, 0, 1, 2}) {
            for (const auto& [length, arm] : {std::pair(1, 1), {4, 3}, {5, 1}, {17, 3}, {40, 1}}) {
                const std::string name = "orthogonal " + std::to_string(left) + " " + std::to_string(right) + " of " +
                                         std::to_string(length) + ", arms " + std::to_string(arm);
                for (unsigned way = 0; way < 8; ++way) {
                    if (length > 4 && way != 0 && way != 5) continue;
                    add(name + ", way " + std::to_string(way),
                        turned(orthogonal_pattern(left, right, length, arm), way));
                }
            }
        }
    }
    for (const bool start : {false, true}) {
        for (const bool end : {false, true}) {
            for (const int steps : {2, 5, 12, 26}) {
                const std::string name =
                    "diagonal " + std::to_string(start) + std::to_string(end) + " of " + std::to_string(steps);
                for (unsigned way = 0; way < 8; ++way) {
                    add(name + ", way " + std::to_string(way), turned(diagonal_pattern(start, end, steps), way));
                }
            }
        }
    }
    add("text", text_picture(glm::vec4(0, 0, 0, 1), glm::vec4(1)));
    add("text in colours of one luma", text_picture({0.8F, 0.2F, 0.2F, 1}, {0.2F, 0.3784F, 0.2F, 1}));
    for (const int levels : {2, 3, 6, 256}) {
        const auto seed = static_cast<unsigned>(levels);
        add("gray noise of " + std::to_string(levels), noise_picture(37, 29, seed, levels, true));
        add("noise of " + std::to_string(levels), noise_picture(29, 37, seed, levels, false));
    }
    add("gradient", painted(64, 24, [](int x, int y) {
            return glm::vec4(static_cast<float>(x) / 63, static_cast<float>(y) / 23, 0.5F, 1);
        }));
    add("steep gradient", painted(24, 24, [](int x, int y) {
            return glm::vec4(glm::vec3(static_cast<float>((x * 3 + y * 5) % 24) / 23), 1);
        }));
    add("checkerboard",
        painted(18, 18, [](int x, int y) { return glm::vec4(glm::vec3(static_cast<float>((x + y) % 2)), 1); }));
    add("grid",
        painted(33, 33, [](int x, int y) { return glm::vec4(glm::vec3(x % 4 == 0 || y % 4 == 0 ? 1.0F : 0.0F), 1); }));
    add("circle", painted(48, 48, [](int x, int y) {
            return glm::vec4(
                glm::vec3(std::hypot(static_cast<float>(x) - 23.3F, static_cast<float>(y) - 24.1F) < 19.7F ? 0.9F
                                                                                                           : 0.15F),
                1);
        }));
    add("rings", painted(64, 64, [](int x, int y) {
            return glm::vec4(glm::vec3(0.5F + 0.5F * std::cos(0.02F * static_cast<float>(x * x + y * y))), 1);
        }));
    add("one pixel", painted(1, 1, [](int, int) { return glm::vec4(0.3F, 0.6F, 0.9F, 1); }));
    add("a row", noise_picture(31, 1, 5, 3, true));
    add("a column", noise_picture(1, 31, 6, 3, true));
    add("two rows", noise_picture(50, 2, 7, 2, true));
    add("long line",
        painted(150, 3, [](int x, int y) { return glm::vec4(glm::vec3(y > (x > 140 ? 0 : 1) ? 1.0F : 0.0F), 1); }));
    add("coverage", painted(24, 24, [](int x, int y) {
            return std::hypot(static_cast<float>(x) - 11.0F, static_cast<float>(y) - 12.0F) < 8
                       ? glm::vec4(0.2F, 0.9F, 0.4F, 1)
                       : glm::vec4(1, 0, 1, 0.25F * static_cast<float>(x % 2));
        }));
    return all;
}

}  // namespace blush::test
