#include "tools/make_face/strands.h"

#include "rig/random.h"

namespace blush::make_face {
namespace {

/// Coverage and colour while strands are laid over each other, the later over the earlier.
struct Canvas {
    int width, height;
    std::vector<Vec3> light;
    std::vector<double> cover;

    Canvas(int w, int h)
        : width(w),
          height(h),
          light(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), Vec3(0)),
          cover(light.size(), 0) {}

    void lay(int x, int y, double amount, const Vec3& color) {
        if (x < 0 || x >= width || y < 0 || y >= height || amount <= 0) return;
        const auto k = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        const double a = std::min(amount, 1.0);
        light[k] = light[k] * (1 - a) + color * a;  // premultiplied
        cover[k] = cover[k] * (1 - a) + a;
    }
};

/// A strand from the canvas' top downward: its middle and half its width by its own parameter, in texels.
struct StrandShape {
    double length = 0;  ///< texels along y
    double root_x = 0, lean = 0, wave = 0, wave_phase = 0, half_width = 1;
    Vec3 color{1};
    double first_y = 0;
};

void draw(Canvas& canvas, const StrandShape& s, double root_dark, double tip_light) {
    for (int y = static_cast<int>(s.first_y); y < static_cast<int>(std::ceil(s.first_y + s.length)); ++y) {
        const double t = std::clamp((y + 0.5 - s.first_y) / s.length, 0.0, 1.0);
        const double x = s.root_x + s.lean * t * t + s.wave * std::sin(s.wave_phase + 3.0 * t) * t;
        const double half = s.half_width * std::pow(1 - t, 0.55) + 0.12;
        const double strength = smooth_step(1.02, 0.72, t) * smooth_step(-0.01, 0.10, t);
        const Vec3 color = s.color * mix(root_dark, tip_light, smooth_step(0, 0.6, t));
        for (int k = static_cast<int>(std::floor(x - half - 1)); k <= static_cast<int>(std::ceil(x + half + 1)); ++k) {
            const double covered = std::clamp(half + 0.5 - std::abs(k + 0.5 - x), 0.0, 1.0) * std::min(1.0, 2 * half);
            // Round: a strand is lighter along its middle.
            const double round = 1 - 0.25 * std::min(1.0, std::abs(k + 0.5 - x) / (half + 0.3));
            canvas.lay(k, y, strength * covered, color * round);
        }
    }
}

/// Bare texels take the mean colour of the strands, so that filtering does not fringe them.
void store(const Canvas& canvas, int left, int top, double factor, Picture& picture) {
    Vec3 sum(0);
    double weight = 1e-9;
    for (std::size_t k = 0; k < canvas.cover.size(); ++k) {
        sum += canvas.light[k];
        weight += canvas.cover[k];
    }
    const Vec3 mean = sum / weight;
    for (int y = 0; y < canvas.height; ++y) {
        for (int x = 0; x < canvas.width; ++x) {
            const auto k =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(canvas.width) + static_cast<std::size_t>(x);
            const double cover = canvas.cover[k];
            picture.set(left + x, top + y, factor * (cover > 0.02 ? canvas.light[k] / cover : mean));
            picture.at(left + x, top + y)[3] = to_byte(cover);
        }
    }
}

/// A lock: strands that part from their neighbours and run together to its tip.
void draw_lock(Canvas& canvas, Random& random, double middle, double half_width, int strands, double length) {
    const double width = canvas.width, height = canvas.height;
    const double tone = random.between(0.62, 1.12), warm = random.between(-0.08, 0.08);
    const double lean = width * random.between(-0.10, 0.10), wave = width * random.between(-0.04, 0.04),
                 phase = random.between(0, 6.28);
    for (int n = 0; n < strands; ++n) {
        StrandShape s;
        const double across = random.between(-1, 1);
        s.root_x = middle + across * half_width;
        s.first_y = height * random.between(0, 0.12);
        s.length = height * length * random.between(0.72, 1) * (1 - 0.15 * square(across)) - s.first_y;
        s.lean = lean - across * half_width * random.between(0.35, 0.75) + width * random.between(-0.02, 0.02);
        s.wave = wave + width * random.between(-0.015, 0.015);
        s.wave_phase = phase;
        s.half_width = height / 512.0 * random.between(0.42, 0.75);
        // The later lie on top and catch the light.
        const double bright = tone * mix(0.66, 1.0, static_cast<double>(n) / strands) * random.between(0.82, 1.15);
        s.color = bright * Vec3(1 + warm, 1, 1 - warm);
        draw(canvas, s, 0.60, 1.0);
    }
}

}  // namespace

ClumpArea hair_clump(int clump, bool shaded) {
    constexpr double margin = 0.004;  // less would let a neighbour in by filtering
    const double left = static_cast<double>(clump) / hair_clumps, top = shaded ? 0.5 : 0.0;
    return {left + margin, left + 1.0 / hair_clumps - margin, top + margin, top + 0.5 - margin};
}

Picture paint_hair_strands(int width) {
    Picture picture(width, 2 * width, 4);
    const int column = width / hair_clumps;
    Random random(11);
    for (int clump = 0; clump < hair_clumps; ++clump) {
        Canvas canvas(column, width);
        if (clump < sparse_hair_clumps) {
            for (int n = 0; n < 9; ++n) {
                StrandShape s;
                s.root_x = column * (0.12 + 0.095 * n + random.between(-0.05, 0.05));
                s.first_y = width * random.between(0, 0.35);
                s.length = width * random.between(0.6, 0.985) - s.first_y;
                s.lean = column * random.between(-0.2, 0.2);
                s.wave = column * random.between(-0.06, 0.06);
                s.wave_phase = random.between(0, 6.28);
                s.half_width = width / 512.0 * random.between(1.0, 1.6);
                s.color = Vec3(random.between(0.7, 1.05));
                draw(canvas, s, 0.8, 1.0);
            }
        } else {
            // The deepest first, without gaps; then locks over them, each with a tone of its own.
            draw_lock(canvas, random, 0.5 * column, 0.42 * column, 40, 0.66);
            for (int n = 0; n < 7; ++n)
                draw_lock(canvas, random, column * (0.11 + 0.13 * ((3 * n) % 7) + random.between(-0.03, 0.03)),
                          0.085 * column, 9, random.between(0.70, 0.985));
        }
        store(canvas, clump * column, 0, 1, picture);
        store(canvas, clump * column, width, 0.6, picture);
    }
    return picture;
}

Picture paint_brow_strands(int side) {
    Picture picture(side, side, 4);
    Canvas canvas(side, side);
    Random random(23);
    constexpr int hairs = 6;
    for (int n = 0; n < hairs; ++n) {
        StrandShape s;
        s.root_x = side * (0.14 + 0.72 * (n + random.between(0.1, 0.9)) / hairs);
        s.first_y = side * random.between(0, 0.3);
        s.length = side * random.between(0.68, 0.99) - s.first_y;
        s.lean = side * random.between(-0.10, 0.10);
        s.wave = side * random.between(-0.02, 0.02);
        s.half_width = side / 128.0 * random.between(3.4, 4.6);
        s.color = Vec3(random.between(0.7, 1.0));
        draw(canvas, s, 1.0, 1.0);
    }
    store(canvas, 0, 0, 1, picture);
    return picture;
}

Picture paint_lash_strands(int side) {
    Picture picture(side, side, 4);
    Canvas canvas(side, side);
    Random random(37);
    constexpr int lashes = 6;
    for (int n = 0; n < lashes; ++n) {
        StrandShape s;
        s.root_x = side * (0.10 + 0.80 * (n + random.between(0.2, 0.8)) / lashes);
        s.length = side * (n % 3 == 1 ? random.between(0.9, 0.99) : random.between(0.6, 0.85));
        // Neighbours lean to the longest of their group.
        s.lean = side * (n % 3 == 0 ? 0.09 : n % 3 == 2 ? -0.09 : 0.0) + side * random.between(-0.02, 0.02);
        s.half_width = side / 128.0 * random.between(3.4, 4.4);
        draw(canvas, s, 1.0, 1.0);
    }
    store(canvas, 0, 0, 1, picture);
    return picture;
}

}  // namespace blush::make_face
