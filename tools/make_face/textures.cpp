#include "tools/make_face/textures.h"

#include "runtime/load/image_file.h"
#include "tools/make_face/eyes.h"
#include "tools/make_face/hair.h"
#include "tools/make_face/head_shape.h"
#include "tools/make_face/parallel.h"

namespace blush::make_face {
namespace {

using namespace landmark;

/// Colours are mixed as sRGB values, 0 to 1, as a painter would.
using Color = Vec3;

Color blend(const Color& a, const Color& b, double t) { return a + (b - a) * t; }

unsigned char to_byte(double x) { return static_cast<unsigned char>(std::lround(std::clamp(x, 0.0, 1.0) * 255)); }

/// A texel's place: the skin's triangle above it, interpolated.
struct Spot {
    Vec3 p, normal;
    Part part = Part::skin;
    double depth = 0;
    int lip = 0;
};

/// The rows from first_row to last_row of the texture, both included.
template <class Paint>
void paint_rows(const Head& head, int side, int first_row, int last_row, Paint paint) {
    const Mesh& mesh = head.mesh;
    for (const Triangle& t : mesh.triangles) {
        const Vec2 a = mesh.uv[t[0]] * static_cast<double>(side), b = mesh.uv[t[1]] * static_cast<double>(side),
                   c = mesh.uv[t[2]] * static_cast<double>(side);
        const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        if (std::abs(area) < 1e-9) continue;
        constexpr double past_edge_texels = 0.7;  // so that no texel of a seam stays bare
        const double least_a = -past_edge_texels * glm::length(c - b) / std::abs(area),
                     least_b = -past_edge_texels * glm::length(a - c) / std::abs(area),
                     least_c = -past_edge_texels * glm::length(b - a) / std::abs(area);
        const auto low = [&](double x, double y, double z) {
            return std::max(0, static_cast<int>(std::floor(std::min({x, y, z}) - 1)));
        };
        const auto high = [&](double x, double y, double z) {
            return std::min(side - 1, static_cast<int>(std::ceil(std::max({x, y, z}) + 1)));
        };
        Spot spot;
        for (const Index v : t) {
            const VertexTag& tag = head.tags[v];
            if (tag.part != Part::skin) spot.part = tag.part;
            if (tag.lip != 0) spot.lip = tag.lip;
        }
        for (int y = std::max(first_row, low(a.y, b.y, c.y)); y <= std::min(last_row, high(a.y, b.y, c.y)); ++y) {
            for (int x = low(a.x, b.x, c.x); x <= high(a.x, b.x, c.x); ++x) {
                const Vec2 q(x + 0.5, y + 0.5);
                double wa = ((b.x - q.x) * (c.y - q.y) - (c.x - q.x) * (b.y - q.y)) / area;
                double wb = ((c.x - q.x) * (a.y - q.y) - (a.x - q.x) * (c.y - q.y)) / area;
                double wc = 1 - wa - wb;
                if (wa < least_a || wb < least_b || wc < least_c) continue;
                spot.p = mesh.positions[t[0]] * wa + mesh.positions[t[1]] * wb + mesh.positions[t[2]] * wc;
                spot.normal =
                    glm::normalize(mesh.normals[t[0]] * wa + mesh.normals[t[1]] * wb + mesh.normals[t[2]] * wc);
                spot.depth = head.tags[t[0]].depth * wa + head.tags[t[1]].depth * wb + head.tags[t[2]].depth * wc;
                paint(x, y, spot);
            }
        }
    }
}

/// Runs `paint(x, y, spot)` for every texel that a triangle of the head covers.
template <class Paint>
void for_each_texel(const Head& head, int side, Paint paint) {
    parallel_pieces(side, [&](int first_row, int last_row) { paint_rows(head, side, first_row, last_row - 1, paint); });
}

/// Distance from p to the edge of the nearer eye's upper or lower lid, front view, millimetres; positive outside the
/// opening.
double lid_edge_distance(const Vec3& p, bool upper) {
    const double x = std::abs(p.x);
    const double height = p.y - canthal_y(x);
    return upper ? height - upper_lid_height(x) : -height - lower_lid_height(x);
}

/// How much a place is red lip, 0 to 1. Outline: cupid's bow above, one arc below.
double lip_cover(const Vec3& p) {
    const double x = std::abs(p.x), t = x / mouth_corner_x;
    if (t > 1.05 || p.z < 60) return 0;
    const double closing = std::pow(std::max(0.0, 1 - square(std::min(t, 1.0))), 0.72);
    const double bow = 1.3 * bell(x, 3.4);
    const double top = lip_line_y(x) + 7.6 * closing - bow;
    const double bottom = lip_line_y(x) - 10.6 * std::pow(closing, 0.9);
    constexpr double soft = 1.3;
    return smooth_step(top + soft, top - soft, p.y) * smooth_step(bottom - soft, bottom + soft, p.y);
}

/// How much a place is covered by the hairs of a brow, 0 to 1.
double brow_cover(const Vec3& p) {
    const double x = std::abs(p.x);
    const double s = (x - 9.5) / 39.0;  // 0 at the brow's head, 1 at its tail
    if (s < -0.1 || s > 1.1 || p.z < 20 || p.y < 5 || p.y > 40) return 0;
    const double middle =
        19.2 + 4.6 * std::sin(pi * 0.5 * std::clamp(s / 0.68, 0.0, 1.0)) - 6.5 * square(std::max(0.0, s - 0.66) / 0.34);
    const double half_width = mix(3.9, 1.0, smooth_step(0.25, 1.05, s)) * smooth_step(-0.06, 0.06, s);
    const double across = (p.y - middle) / std::max(half_width, 0.1);
    // Hairs: streaks that run upward at the head of the brow and lean outward toward its tail.
    const double lean = radians(mix(72, 8, smooth_step(0, 0.55, s)));
    const Vec2 along(std::cos(lean), std::sin(lean));
    const Vec2 q(x - 9.5, p.y - middle);
    const double streak =
        noise({glm::dot(q, along) / 3.6, (-along.y * q.x + along.x * q.y) / 0.42, p.x > 0 ? 3.5 : 9.5}) +
        0.5 * noise({glm::dot(q, along) / 2.1, (-along.y * q.x + along.x * q.y) / 0.23, p.x > 0 ? 13.5 : 19.5});
    const double body =
        smooth_step(1.25, 0.35, std::abs(across)) * smooth_step(-0.05, 0.12, s) * smooth_step(1.06, 0.9, s);
    return std::clamp(body * (0.78 + 0.75 * streak), 0.0, 1.0);
}

Color skin_color(const Vec3& p, const Vec3& normal) {
    const Vec3 half{std::abs(p.x), p.y, p.z};
    Color c(0.855, 0.665, 0.560);
    const auto toward = [&](const Color& to, double t) { c = blend(c, to, std::clamp(t, 0.0, 1.0)); };
    const Color blood(0.80, 0.43, 0.37), warm(0.87, 0.68, 0.53), shadow(0.62, 0.42, 0.36), cool(0.76, 0.60, 0.53);
    toward(warm, 0.5 * smooth_step(25, 55, p.y) * smooth_step(30, 70, p.z));  // forehead
    toward(cool, 0.45 * bell(half, {20, -90, 75}, {34, 22, 40}));             // beard's region
    toward(blood, 0.42 * bell(half, {38, -36, 66}, {17, 15, 22}));            // cheek
    toward(blood, 0.40 * bell(half, {0, -38, 113}, {11, 9, 10}));             // tip of the nose
    toward(blood, 0.30 * bell(half, {15, -42, 98}, {6, 8, 10}));              // its wing
    toward(blood, 0.16 * bell(half, {0, -101, 88}, {14, 10, 16}));            // chin
    toward(shadow, 0.26 * bell(half, {29, -14, 78}, {14, 5, 12}));            // below the eye
    toward(blood, 0.30 * bell(half, {15.5, -3, 78}, {5, 5, 8}));              // inner canthus
    toward(shadow, 0.22 * bell(half, {32, 11, 80}, {15, 4, 10}));             // fold of the upper lid
    toward(Color(0.34, 0.17, 0.14),
           0.95 * bell(half, {6.6, -45, 99.5}, {4.2, 4.0, 6.5}) * smooth_step(0.35, -0.15, normal.z));  // nostril
    toward(blood, 0.16 * (0.5 + 0.5 * fractal_noise(p / 9.0, 3)));                                      // uneven tone
    toward(cool, 0.22 * smooth_step(-0.2, 0.9, fractal_noise(p / 17.0 + Vec3(3, 7, 1), 2)));
    toward(shadow, 0.20 * bell(half, {0, -86.5, 92}, {16, 3.5, 14}));  // below the lower lip
    toward(shadow, 0.16 * bell(half, {19.5, -49, 86}, {3.5, 9, 14}));  // nasolabial fold
    // Freckles: a few of the lattice's cells, over the nose and the cheeks.
    const double freckled = bell(half, {24, -26, 84}, {26, 13, 26});
    const double speck = fractal_noise(Vec3(p.x + 0.6 * p.y, p.y - 0.6 * p.x, p.z) / 1.25 + Vec3(91, 13, 47), 2);
    toward(Color(0.66, 0.44, 0.34), 0.26 * freckled * smooth_step(0.65, 1.1, speck));
    const double grain = 1 + 0.022 * fractal_noise(p / 1.3, 3) + 0.018 * fractal_noise(p / 5.0, 2);
    return c * grain;
}

Color ear_color(const Vec3& p) {
    const Color skin(0.84, 0.60, 0.51), blood(0.78, 0.40, 0.34), deep(0.40, 0.20, 0.16);
    Color c = blend(skin, blood, 0.35 + 0.12 * fractal_noise(p / 7.0, 2));
    const Vec3 half{std::abs(p.x), p.y, p.z};
    c = blend(c, deep, 0.85 * bell(half, ear_centre + Vec3(0, -3, 5), {9, 5, 5}));
    return c;
}

Color face_color(const Spot& spot) {
    const Vec3& p = spot.p;
    const Color lip_red(0.75, 0.43, 0.40), lip_dark(0.46, 0.17, 0.17), lash(0.13, 0.075, 0.06), rim(0.80, 0.52, 0.47);
    if (spot.part == Part::ear) return ear_color(p);
    if (spot.part == Part::mouth_lining) {
        const Color deep(0.16, 0.05, 0.05), flesh(0.62, 0.27, 0.26);
        const Color front = blend(lip_red * 0.9, flesh, smooth_step(0.1, 0.35, spot.depth));
        return blend(front, deep, smooth_step(0.3, 0.62, spot.depth));
    }
    if (spot.part == Part::lid_lining) return blend(rim, Color(0.45, 0.20, 0.18), smooth_step(0.3, 0.9, spot.depth));

    const double hair = hair_paint(p);
    if (hair >= 1) return hair_color(p);
    Color c = skin_color(p, spot.normal);
    const double lip = lip_cover(p);
    if (lip > 0) {
        const double wrinkle = 1 + 0.05 * noise({p.x / 0.9, p.y / 7.0, 4.5});
        const double meeting =
            bell(p.y - lip_line_y(p.x), 1.1) * smooth_step(mouth_corner_x + 1, mouth_corner_x - 2, std::abs(p.x));
        c = blend(c, blend(lip_red, lip_dark, 0.75 * meeting) * wrinkle, 0.74 * lip);
    }
    // The rims of the lids: dark where the lashes root, upper more than lower.
    const double x = std::abs(p.x);
    if (p.z > 50 && x > inner_canthus.x - 1 && x < outer_canthus.x + 3) {
        const double t = (x - inner_canthus.x) / (outer_canthus.x - inner_canthus.x);
        const double ends = smooth_step(-0.02, 0.15, t) * smooth_step(1.08, 0.95, t);
        if (p.y > canthal_y(x) - 0.3) c = blend(c, lash, 0.88 * ends * bell(lid_edge_distance(p, true), 1.15));
        if (p.y < canthal_y(x) + 0.3) c = blend(c, lash, 0.42 * ends * bell(lid_edge_distance(p, false), 0.9));
    }
    const Color brow_hair(0.215, 0.135, 0.10);
    c = blend(c, brow_hair, 0.9 * brow_cover(p));
    if (hair > 0) c = blend(c, hair_color(p), hair);
    return c;
}

}  // namespace

Picture paint_skin(const Head& head, int side) {
    Picture picture{side,
                    std::vector<unsigned char>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 3)};
    for (std::size_t k = 0; k < picture.rgb.size(); k += 3) {
        picture.rgb[k] = 205;  // bare texels take the mean skin, so that mip levels do not darken at the seams
        picture.rgb[k + 1] = 155;
        picture.rgb[k + 2] = 132;
    }
    // The crown's triangles are thinner than a texel where they run along the strip of the ears: hair all round them.
    constexpr double margin_begin = 0.15, margin_end = 0.175;
    const Color crown = hair_color({0, 120, -5});
    for (int y = static_cast<int>(margin_begin * side); y < static_cast<int>(margin_end * side); ++y) {
        for (int x = 0; x < side; ++x)
            for (int k = 0; k < 3; ++k) {
                picture.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                                 static_cast<std::size_t>(x)) +
                            static_cast<std::size_t>(k)] = to_byte(crown[k]);
            }
    }
    for_each_texel(head, side, [&](int x, int y, const Spot& spot) {
        const Color c = face_color(spot);
        const std::size_t at =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x));
        for (int k = 0; k < 3; ++k) picture.rgb[at + static_cast<std::size_t>(k)] = to_byte(c[k]);
    });
    return picture;
}

Picture paint_roughness(const Head& head, int side) {
    constexpr double skin = 0.52, oily = 0.43, lip = 0.38, hair = 1, wet = 0.3;
    Picture picture{side,
                    std::vector<unsigned char>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 3)};
    for (std::size_t k = 1; k < picture.rgb.size(); k += 3) picture.rgb[k] = to_byte(skin);
    for_each_texel(head, side, [&](int x, int y, const Spot& spot) {
        const Vec3 half{std::abs(spot.p.x), spot.p.y, spot.p.z};
        const double shine = std::max(bell(half, {0, -25, 104}, {14, 26, 24}), bell(half, {0, 40, 90}, {34, 22, 24}));
        double roughness = mix(skin, oily, shine);
        if (spot.part == Part::skin) {
            roughness = mix(roughness, lip, 0.8 * lip_cover(spot.p));
            roughness = mix(roughness, hair, std::max(hair_paint(spot.p), 0.8 * brow_cover(spot.p)));
        }
        if (spot.part == Part::mouth_lining || spot.part == Part::lid_lining)
            roughness = mix(lip, wet, smooth_step(0, 0.2, spot.depth));
        // No light reaches the depth of the mouth; a renderer without shadows must not find a highlight there.
        if (spot.part == Part::mouth_lining) roughness = mix(roughness, 1, smooth_step(0.25, 0.5, spot.depth));
        picture
            .rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x)) + 1] =
            to_byte(roughness);
    });
    return picture;
}

Picture paint_eye(int side) {
    Picture picture{side, {}};
    picture.rgb.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 3);
    const double limbus = limbus_angle / eye_texture_angle * 0.97;  // radius in the texture, where 1 is its edge
    const double pupil = limbus * 0.36;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double px = 2 * (x + 0.5) / side - 1, py = 1 - 2 * (y + 0.5) / side;
            const double r = std::hypot(px, py), turn = std::atan2(py, px);
            const double across = 3 * std::cos(turn), up = 3 * std::sin(turn);

            Color sclera(0.83, 0.80, 0.77);
            // The ball darkens toward the lids, which shade it, and reddens toward its corners.
            sclera = blend(sclera, Color(0.60, 0.47, 0.43), smooth_step(limbus * 1.25, limbus * 2.6, r));
            sclera = blend(sclera, Color(0.74, 0.47, 0.42), 0.6 * smooth_step(limbus * 1.7, 0.85, r));
            const double vein = std::abs(fractal_noise({across * 3, up * 3, r * 5}, 3));
            sclera = blend(sclera, Color(0.76, 0.36, 0.33),
                           0.45 * smooth_step(0.10, 0.0, vein) * smooth_step(limbus * 1.3, 0.6, r));

            // Iris: radial fibres, a lighter collarette round the pupil, a dark limbal ring.
            const double f = std::clamp((r - pupil) / (limbus - pupil), 0.0, 1.0);
            const double fibre = fractal_noise({across * 9, up * 9, f * 1.2}, 3);
            Color iris =
                blend(Color(0.36, 0.27, 0.15), Color(0.27, 0.335, 0.33), smooth_step(0.10, 0.55, f + 0.18 * fibre));
            iris = iris * (0.92 + 0.30 * fibre);
            iris = blend(iris, Color(0.07, 0.09, 0.11), smooth_step(0.72, 1.0, f));
            iris = blend(iris, Color(0.02), smooth_step(0.10, 0.0, f));

            Color c = blend(iris, sclera, smooth_step(limbus * 0.94, limbus * 1.07, r));
            c = blend(Color(0.012), c, smooth_step(pupil * 0.93, pupil * 1.05, r));
            for (int k = 0; k < 3; ++k) picture.rgb.push_back(to_byte(c[k]));
        }
    }
    return picture;
}

namespace {
/// `paint(u, v)` at every texel's middle.
template <class Paint>
Picture paint_square(int side, Paint paint) {
    Picture picture{side, {}};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const Color c = paint((x + 0.5) / side, (y + 0.5) / side);
            for (int k = 0; k < 3; ++k) picture.rgb.push_back(to_byte(c[k]));
        }
    }
    return picture;
}
const Color throat(0.16, 0.05, 0.05);
}  // namespace

Picture paint_gum(int side) {
    return paint_square(side, [](double u, double v) {
        const Color pink = Color(0.70, 0.38, 0.37) * (1 + 0.06 * fractal_noise({u * 60, v * 12, 0.5}, 2));
        return blend(pink, throat, smooth_step(0.34, 0.52, v));
    });
}

Picture paint_tongue(int side) {
    return paint_square(side, [](double u, double v) {
        const double papillae = fractal_noise({u * 70, v * 50, 0.5}, 2);
        const Color flesh = Color(0.70, 0.38, 0.37) * (1 + 0.09 * papillae);
        return blend(throat, flesh, smooth_step(0.25, 0.95, v));
    });
}

Picture paint_pores(const Head& head, int side) {
    // A height field of cells about 0.7 mm wide on the face, finer than any vertex; slopes by central differences of
    // the function itself, in the texture's own directions.
    Picture picture{side, {}};
    picture.rgb.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 3, 128);
    for (std::size_t k = 2; k < picture.rgb.size(); k += 3) picture.rgb[k] = 255;
    const auto pores = [](const Vec3& p) { return 0.045 * fractal_noise(p / 0.9, 2); };
    for_each_texel(head, side, [&](int x, int y, const Spot& spot) {
        if (spot.part != Part::skin) return;
        const bool hairy = hair_cover(spot.p) > 0.3;
        const Vec3 up = glm::normalize(Vec3(0, 1, 0) - spot.normal * spot.normal.y + Vec3(1e-9, 0, 0));
        const Vec3 right = glm::cross(up, spot.normal);
        const double h = hairy ? 0.4 : 0.12;  // less than a pore or a strand is wide
        const auto height = [&](const Vec3& p) { return hairy ? hair_relief(p) : pores(p); };
        const double gentle = 1 - 0.6 * bell(Vec3(std::abs(spot.p.x), spot.p.y, spot.p.z), eye_centre, {22, 14, 22});
        const double dx = gentle * (height(spot.p + right * h) - height(spot.p - right * h)) / (2 * h);
        const double dy = gentle * (height(spot.p + up * h) - height(spot.p - up * h)) / (2 * h);
        const Vec3 n = glm::normalize(Vec3(-dx, -dy, 1));
        const std::size_t at =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x));
        for (int k = 0; k < 3; ++k) picture.rgb[at + static_cast<std::size_t>(k)] = to_byte(0.5 + 0.5 * n[k]);
    });
    return picture;
}

std::vector<unsigned char> png(const Picture& picture) {
    const auto side = static_cast<std::uint32_t>(picture.side);
    return load::encode_png(side, side, 3, picture.rgb);
}

}  // namespace blush::make_face
