#include "tools/make_face/pigments.h"

#include "rig/blood/colour_difference.h"
#include "tools/make_face/brow_cards.h"
#include "tools/make_face/cells.h"
#include "tools/make_face/hair.h"
#include "tools/make_face/head_shape.h"
#include "tools/make_face/skin_regions.h"

namespace blush::make_face {
namespace {

using namespace landmark;

/// 1 on the middle of thin winding lines, `width` of the noise's cell wide.
double winding(const Vec3& q, double width) { return smooth_step(width, 0, std::abs(noise(q) + 0.5 * noise(q * 2.1))); }

/// Round specks of different size, one in some of the cells of a lattice `cell` mm wide: 0 to 1.
double specks(const Vec3& p, double cell, double share) {
    const Vec3 q = p / cell;
    double most = 0;
    each_cell(q, [&](const Cell& c) {
        if (c.luck[3] > share) return;
        const double d = glm::distance(q, c.point) / mix(0.14, 0.34, c.luck[4]);
        if (d > 1.6) return;
        const double ragged = 0.25 * noise(p / (0.25 * cell));
        most = std::max(most, smooth_step(1.25, 0.55, d + ragged) * mix(0.45, 1, c.luck[5]));
    });
    return most;
}

struct Mole {
    Vec2 place;  ///< x, y as seen from the front
    double radius_mm, strength;
};
constexpr Mole moles[] = {{{37, -47}, 1.0, 1.0},   {{-29, -61}, 0.75, 0.8}, {{-14, 47}, 0.7, 0.6},
                          {{48, -14}, 0.8, 0.7},   {{-45, -30}, 0.6, 0.6},  {{9, -58}, 0.55, 0.5},
                          {{-33, -118}, 1.1, 0.9}, {{22, -131}, 0.8, 0.7}};

double mole_cover(const Vec3& p) {
    if (p.z < 0) return 0;
    double most = 0;
    for (const Mole& mole : moles) {
        const double d = glm::length(Vec2(p) - mole.place) / mole.radius_mm;
        if (d < 2) most = std::max(most, mole.strength * smooth_step(1.2, 0.6, d + 0.2 * noise(p / 0.5)));
    }
    return most;
}

/// Melanin at a place over that of the typical skin.
double melanin_factor(const Vec3& p, const Vec3& half, double lip, const SkinTone& look) {
    double f = 1 + 0.14 * fractal_noise(p / 15.0 + Vec3(3, 7, 1), 3) + 0.10 * fractal_noise(p / 2.6, 2) +
               0.05 * noise(p / 0.9);
    f += 0.14 * bell(half, {0, 42, 90}, {50, 30, 34}) + 0.14 * bell(half, {0, -22, 100}, {13, 22, 20}) +
         0.10 * bell(half, {44, -24, 60}, {22, 16, 24});  // what faces the sun
    f += 0.34 * bell(half, {30, -12, 78}, {15, 6, 14}) + 0.26 * bell(half, {32, 9, 80}, {17, 6, 12}) +
         0.22 * bell(half, {17, -4, 78}, {6, 8, 9});                     // the eyes' surroundings
    f += 0.10 * bell(half, {0, -84, 92}, {24, 16, 18});                  // about the mouth
    f += 0.14 * bell(half, {22, -50, 84}, {4, 10, 12});                  // nasolabial fold
    f -= 0.16 * smooth_step(-95, -125, p.y) * smooth_step(80, 30, p.z);  // the jaw's shade
    // Lips keep less of it, and the more the darker the skin is.
    f = mix(f, 0.85 + 0.1 * noise(p / 2.0), lip * 0.8);
    const double freckled =
        std::max({bell(half, {22, -24, 88}, {26, 13, 30}), 0.55 * bell(half, {0, 38, 92}, {44, 22, 30}),
                  0.35 * bell(half, {48, -34, 52}, {20, 22, 26})});
    if (look.freckles > 0 && freckled > 0.02) {
        const double dots = std::max(specks(p, 2.6, 0.55), 0.7 * specks(p + Vec3(0.7, 1.9, 0.4), 4.4, 0.4));
        f += 3.2 * look.freckles * freckled * dots * (1 - lip);
    }
    return std::max(f, 0.3);
}

/// Hemoglobin over that of the typical skin.
double hemoglobin_factor(const SurfaceTexel& texel, const Vec3& p, const Vec3& half) {
    double f = 1 + 0.20 * fractal_noise(p / 11.0, 3) + 0.20 * fractal_noise(p / 3.3 + Vec3(9, 2, 4), 2) +
               0.10 * noise(p / 0.8 + Vec3(5, 1, 8));
    const double cheek = bell(half, {40, -34, 64}, {18, 16, 24}), tip = bell(half, {0, -37, 112}, {10, 9, 11}),
                 wing = bell(half, {14, -41, 97}, {7, 8, 11});
    f += 1.6 * cheek + 1.6 * tip + 1.5 * wing;
    f += 0.70 * bell(half, {0, -99, 88}, {13, 9, 16}) + 0.35 * bell(half, {0, 8, 96}, {9, 8, 10});  // chin, glabella
    f += 0.55 * around_eye(half) + 0.75 * bell(half, {16, -3, 78}, {5, 5, 8});
    f += 0.35 * bell(half, {22, -50, 84}, {4, 9, 12});
    f -= 0.25 * bell(half, {0, 44, 90}, {46, 20, 34});  // the forehead is yellower
    f -= 0.22 * bell(half, {0, -60, 96}, {13, 6, 12});  // the upper lip's skin is pale
    if (texel.part == Part::ear) f += 1.5;
    // Single vessels and blotches where the skin is full.
    const double full = std::max({cheek, wing, 0.7 * tip});
    if (full > 0.05) {
        f += 0.55 * full * winding(p / Vec3(2.6, 1.7, 2.6), 0.05) * smooth_step(0.1, 0.5, noise(p / 6.0) + 0.2);
        f += 0.35 * full * fractal_noise(p / 4.7 + Vec3(13, 3, 3), 2);
    }
    return std::max(f, 0.25);
}

/// Light skin of the table is darker than people's (L* 62 at the 1 % melanin of Jacques' lightest; measured faces have
/// 65 to 72), since what the surface reflects is not in it, and less yellow (b* 11 to 14; measured 15 to 19: Xiao et
/// al. 2017), since it has no carotene (Alaluf et al. 2002b). Photographed skin comes out of it as much brighter, too
/// (docs/appearance.md).
const glm::vec3 white(1.26F, 1.20F, 1.11F);

struct Pigment {
    double melanin = 0, hemoglobin = 0;
    double skin = 1;    ///< as AppearanceMaps::skin
    Vec3 over{0};       ///< linear sRGB of what lies over the skin
    double cover = 0;   ///< how much of the skin it hides
    double shadow = 1;  ///< factor on the colour below it: where no light reaches
    Vec3 tint{1};       ///< and what lies deeper than the model's skin: veins
};

/// Red lips are an epidermis without its horny layer over many vessels.
double lip_hemoglobin(const SkinTone& look) { return 0.055 + 2.6 * look.hemoglobin; }

/// Turns skin to red lip by a share.
void redden(Pigment& pigment, const Vec3& p, double lip, const SkinTone& look) {
    const double furrow = 0.5 + 0.5 * noise({p.x / 0.8, p.y / 6.0, 4.5});
    const double red = lip_hemoglobin(look) * (1 + 0.20 * fractal_noise(p / 3.0, 2)) * mix(0.85, 1.1, furrow);
    pigment.hemoglobin = mix(pigment.hemoglobin, red, 0.94 * lip);
    pigment.melanin += lip * (0.002 + 0.05 * look.melanin);
    pigment.shadow *= 1 - 0.10 * lip;
}
/// Of closed lips, where they meet.
double seam_shadow(double seam) { return 1 - 0.5 * seam; }

/// From the lips' edge inward they stay lips for a while, then become the wet lining, which no light reaches.
void line_mouth(Pigment& pigment, const Vec3& p, double depth, const SkinTone& look) {
    redden(pigment, p, 1, look);
    const double inside = smooth_step(0.02, 0.3, depth);
    pigment.melanin = mix(pigment.melanin, 0.012, inside);
    pigment.hemoglobin = mix(pigment.hemoglobin, 1.5 * lip_hemoglobin(look), inside);
    pigment.shadow *=
        mix(mix(seam_shadow(1), 0.62, smooth_step(0.02, 0.12, depth)), 0.16, smooth_step(0.25, 0.95, depth));
    pigment.skin = smooth_step(0.3, 0.05, depth);
}

void line_lid(Pigment& pigment, bool upper, double depth, const SkinTone& look) {
    pigment.melanin = mix(look.melanin * 0.85, 0.012, smooth_step(0, 0.3, depth));
    pigment.hemoglobin = lip_hemoglobin(look) * mix(1.0, 1.5, smooth_step(0, 0.3, depth));
    pigment.shadow = mix(1.0, 0.5, smooth_step(0.3, 0.9, depth));
    if (!upper) return;
    pigment.cover = 0.8 * smooth_step(0.45, 0.1, depth);  // lashes root in it, and it shades itself
    pigment.over = linear_srgb(vec3(look.hair)) * 0.10;
    pigment.shadow *= 0.55;
}

/// Thin skin below the eye and at its inner corner, through which veins show.
double veiled(const Vec3& half) {
    return std::max(bell(half, {27, -13, 78}, {12, 4.5, 14}), 0.8 * bell(half, {17, -7, 78}, {4.5, 6, 8}));
}

/// Hair on the scalp and under brows and lashes.
void cover_with_hair(Pigment& pigment, const Vec3& p, const SkinTone& look) {
    const double rim = std::max(0.85 * lid_rim(p, true), 0.35 * lid_rim(p, false));
    const double root = std::max(rim, 0.62 * brow_cover(p)), scalp = hair_paint(p);
    pigment.cover = std::max(root, scalp);
    if (pigment.cover == 0) return;
    pigment.over = linear_srgb(vec3(look.hair)) * (scalp >= root ? hair_shade(p) : 0.35);
    pigment.skin = 1 - std::max(scalp, 0.6 * root);
}

Pigment pigment_at(const SurfaceTexel& texel, const SkinTone& look) {
    const Vec3 p = texel.place(), half = texel.half();
    const auto depth = static_cast<double>(texel.depth);
    const double lip = texel.part == Part::skin ? lip_cover(p) : texel.part == Part::mouth_lining ? 1 : 0;
    Pigment result;
    result.melanin = look.melanin * melanin_factor(p, half, lip, look);
    result.hemoglobin = look.hemoglobin * hemoglobin_factor(texel, p, half);
    switch (texel.part) {
        case Part::mouth_lining:
            line_mouth(result, p, depth, look);
            break;
        case Part::lid_lining:
            line_lid(result, p.y > canthal_y(half.x), depth, look);
            break;
        case Part::cut:
        case Part::ear:
            result.shadow = 1 - 0.55 * bell(half, ear_centre + Vec3(0, -3, 5), {9, 5, 5});
            break;
        case Part::skin:
            result.melanin *= 1 - 0.08 * lip_border(p);
            result.hemoglobin *= 1 - 0.15 * lip_border(p);
            result.melanin += mole_cover(p) * (0.10 + 0.7 * look.melanin);
            if (lip > 0) redden(result, p, lip, look);
            result.shadow *= seam_shadow(lip_seam(p)) * (1 - 0.70 * nostril(texel));
            result.tint = glm::mix(Vec3(1), Vec3(0.90, 0.93, 0.99), veiled(half));
            cover_with_hair(result, p, look);
            break;
    }
    return result;
}

float stored(double fraction, double largest) {
    return stored_fraction(stored_byte(static_cast<float>(fraction), largest), largest);
}

}  // namespace

AppearanceMaps paint_pigments(const SurfaceTexels& texels, const SkinTone& look, const SkinColourTable& table) {
    const auto side = static_cast<std::uint32_t>(texels.side());
    AppearanceMaps maps;
    maps.melanin = ScalarMap(side, side, stored(look.melanin, largest_melanin));
    maps.hemoglobin = ScalarMap(side, side, stored(look.hemoglobin, largest_hemoglobin));
    maps.skin = ScalarMap(side, side, 0);
    maps.residual = ColourMap(side, side, glm::vec3(1));
    SkinChromophores kind;
    const bool other_blend = look.melanin_blend != kind.eumelanin_share;
    kind.eumelanin_share = look.melanin_blend;
    const SkinColourTable own(SkinColourTable::default_nodes, SkinColourTable::default_nodes, kind);
    texels.for_each([&](int, int, const SurfaceTexel& texel, std::size_t k) {
        const Pigment pigment = pigment_at(texel, look);
        const float melanin = stored(pigment.melanin, largest_melanin),
                    hemoglobin = stored(pigment.hemoglobin, largest_hemoglobin);
        maps.melanin.values[k] = melanin;
        maps.hemoglobin.values[k] = hemoglobin;
        maps.skin.values[k] = static_cast<float>(pigment.skin);
        const glm::vec3 plain = glm::max(table.colour_linear(melanin, hemoglobin), glm::vec3(1e-4F));
        const glm::vec3 skin = other_blend ? own.colour_linear(melanin, hemoglobin) : plain;
        const auto cover = static_cast<float>(pigment.cover);
        const glm::vec3 colour = glm::mix(skin * white * glm::vec3(pigment.tint * pigment.shadow),
                                          glm::vec3(pigment.over), glm::vec3(cover));
        maps.residual.values[k] = colour / plain;
    });
    texels.fill_margins(std::span(maps.melanin.values), 1);
    texels.fill_margins(std::span(maps.hemoglobin.values), 1);
    texels.fill_margins(std::span(maps.skin.values), 1);
    texels.fill_margins(std::span(maps.residual.values), 1);
    return maps;
}

Picture base_color(const AppearanceMaps& maps, const SkinColourTable& table) {
    const int side = static_cast<int>(maps.melanin.width);
    Picture picture(side, side, 3);
    parallel_pieces(side, [&](int first_row, int last_row) {
        for (int y = first_row; y < last_row; ++y) {
            for (int x = 0; x < side; ++x) {
                const auto k = static_cast<std::size_t>(y) * maps.melanin.width + static_cast<std::size_t>(x);
                const glm::dvec3 c(maps.residual.values[k] *
                                   table.colour_linear(maps.melanin.values[k], maps.hemoglobin.values[k]));
                picture.set(x, y, {srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z)});
            }
        }
    });
    return picture;
}

}  // namespace blush::make_face
