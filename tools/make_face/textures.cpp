#include "tools/make_face/textures.h"

#include "tools/make_face/eyes.h"
#include "tools/make_face/parallel.h"

namespace blush::make_face {
namespace {

/// Colours are mixed as sRGB values, 0 to 1, as a painter would.
using Color = Vec3;

Color blend(const Color& a, const Color& b, double t) { return a + (b - a) * t; }

/// `paint(u, v)` at every texel's middle.
template <class Paint>
Picture paint_square(int side, Paint paint) {
    Picture picture(side, side, 3);
    parallel_pieces(side, [&](int first_row, int last_row) {
        for (int y = first_row; y < last_row; ++y)
            for (int x = 0; x < side; ++x) picture.set(x, y, paint((x + 0.5) / side, (y + 0.5) / side));
    });
    return picture;
}

const Color throat(0.13, 0.04, 0.04);

/// Distance of a place from the nearest of winding lines, in cells.
double line(const Vec3& q) { return std::abs(noise(q) + 0.5 * noise(q * 2.03 + Vec3(5, 3, 1))); }

}  // namespace

Picture paint_eye(int side, const Vec3& iris_color) {
    const double limbus = limbus_angle / eye_texture_angle * 0.97;  // radius in the texture, where 1 is its edge
    const double pupil = limbus * 0.34;
    return paint_square(side, [&](double u, double v) {
        const double px = 2 * u - 1, py = 1 - 2 * v;
        const double r = std::hypot(px, py), turn = std::atan2(py, px);
        const double across = std::cos(turn), up = std::sin(turn);

        // Sclera: bluish beside the iris, yellower and redder toward the corners, with veins that thin out inward.
        Color sclera =
            blend(Color(0.80, 0.795, 0.79), Color(0.79, 0.745, 0.70), smooth_step(limbus * 1.1, limbus * 2.3, r));
        const double corner = smooth_step(limbus * 1.2, limbus * 2.3, std::abs(px));
        sclera = blend(sclera, Color(0.70, 0.47, 0.43), 0.75 * corner);
        sclera = blend(sclera, Color(0.62, 0.50, 0.47), 0.6 * smooth_step(limbus * 1.6, limbus * 2.8, r));
        const Vec3 q(px * 7 + 0.6 * noise({px * 9, py * 9, 2.5}), py * 7 + 0.6 * noise({px * 9, py * 9, 7.5}), 0.5);
        const double thick = smooth_step(0.10, 0.0, line(q)) * smooth_step(limbus * 1.15, limbus * 2.0, r);
        const double thin = smooth_step(0.12, 0.0, line(q * 2.3)) * smooth_step(limbus * 1.05, limbus * 1.7, r);
        sclera =
            blend(sclera, Color(0.68, 0.26, 0.24), std::min(0.55, 0.42 * thick + 0.20 * thin) * mix(0.6, 1, corner));

        // The lids and their lashes shade the ball, the upper more than the lower.
        sclera = sclera * (1 - 0.30 * smooth_step(limbus * 0.55, limbus * 1.15, py) -
                           0.12 * smooth_step(limbus * 0.7, limbus * 1.3, -py));

        // Iris: fibres from the pupil outward, a warmer collarette with a ragged edge, crypts, a dark limbal ring.
        const double f = std::clamp((r - pupil) / (limbus - pupil), 0.0, 1.0);
        const double bend = 0.05 * noise({across * 4, up * 4, f * 3});
        const double ca = std::cos(turn + bend), sa = std::sin(turn + bend);
        const double fibre = 0.6 * noise({ca * 26, sa * 26, f * 2.0}) + 0.4 * noise({ca * 55, sa * 55, f * 3.5});
        const double broad = noise({ca * 7, sa * 7, f * 1.5});
        const double collarette = 0.30 + 0.07 * noise({ca * 9, sa * 9, 4.5});
        const Color warm = blend(iris_color * 0.9, Color(0.47, 0.31, 0.13), 0.55);
        Color iris = blend(warm, iris_color, smooth_step(collarette - 0.12, collarette + 0.16, f + 0.06 * fibre));
        iris = iris * (1 + 0.42 * fibre + 0.18 * broad);
        iris =
            iris * (1 - 0.35 * smooth_step(0.45, 0.8, noise({ca * 11, sa * 11, f * 4 + 9})) * smooth_step(0.2, 0.5, f));
        iris = iris * (1 + 0.25 * bell(f - collarette, 0.06));
        iris = blend(iris, iris_color * 0.16, smooth_step(0.74, 1.0, f));
        iris = iris * (1 - 0.45 * smooth_step(limbus * 0.25, limbus * 0.95, py));  // under the upper lid
        iris = blend(iris, Color(0.02), smooth_step(0.10, 0.0, f));

        Color c = blend(iris, sclera, smooth_step(limbus * 0.93, limbus * 1.08, r));
        return blend(Color(0.010), c, smooth_step(pupil * 0.94, pupil * 1.05, r));
    });
}

Picture paint_teeth(int side) {
    return paint_square(side, [](double u, double v) {
        const double back = 2 * std::abs(u - 0.5);
        const double stain = 0.5 + 0.5 * noise({u * 40, v * 6, 0.5});
        const Color ivory = blend(Color(0.86, 0.83, 0.765), Color(0.82, 0.77, 0.68), 0.6 * stain + 0.4 * back);
        return ivory * mix(1, 0.55, smooth_step(0.25, 0.9, back));
    });
}

Picture paint_gum(int side) {
    return paint_square(side, [](double u, double v) {
        const double mottled = fractal_noise({u * 60, v * 12, 0.5}, 2);
        const Color pink = blend(Color(0.63, 0.33, 0.32), Color(0.52, 0.22, 0.23), 0.5 + 0.5 * mottled);
        return blend(pink, throat, smooth_step(0.35, 0.85, v));
    });
}

Picture paint_tongue(int side) {
    return paint_square(side, [](double u, double v) {
        const double papillae = fractal_noise({u * 70, v * 50, 0.5}, 2);
        const Color flesh = blend(Color(0.66, 0.36, 0.35), Color(0.70, 0.44, 0.42), 0.5 + 0.5 * papillae) *
                            (1 - 0.12 * bell(u - 0.5, 0.05));
        return blend(throat, flesh, smooth_step(-0.1, 0.6, v));
    });
}

}  // namespace blush::make_face
