// Eyes, mouth and hair: their own shading, and that skin and they never change each other's pixels.

#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "rig/head/eye_sockets.h"
#include "runtime/frame/frame_state.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

constexpr std::uint32_t side = 64;

/// Skin with a card of hair before its right half, cut out into columns by its texture.
Face card_before_skin(AlphaMode mode) {
    Face face = test::make_face({.targets = 0});
    for (glm::vec3& position : face.positions) position *= 0.05F;
    Image strands;
    strands.width = strands.height = 16;
    strands.channels = 4;
    for (int p = 0; p < 256; ++p) {
        const bool there = p % 16 / 4 % 2 == 0;
        strands.bytes.insert(strands.bytes.end(), {90, 60, 40, static_cast<std::uint8_t>(there ? 255 : 0)});
    }
    face.images.push_back(strands);
    Material hair;
    hair.name = "hair";
    hair.metallic = 0;
    hair.double_sided = true;
    hair.alpha_mode = mode;
    hair.base_color_srgb.image = 0;
    face.materials.push_back(hair);
    const auto first = static_cast<std::uint32_t>(face.positions.size());
    const auto first_index = static_cast<std::uint32_t>(face.indices.size());
    for (const glm::vec2 p : {glm::vec2(0, -0.04F), glm::vec2(0.04F, -0.04F), glm::vec2(0.04F), glm::vec2(0, 0.04F)}) {
        face.positions.emplace_back(p, 0.05F);
        face.normals.emplace_back(0, 0, 1);
        face.tangents.emplace_back(1, 0, 0, 1);
        face.uv0.emplace_back(p.x / 0.04F, (0.04F - p.y) / 0.08F);
        face.uv1.emplace_back(0);
    }
    face.indices.insert(face.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    test::add_primitive(face, first, first_index);
    face.primitives.back().material = 1;
    face.meshes[0].primitive_count = 2;
    return face;
}

class Parts : public test::GlTest {
protected:
    Image draw(Portrait& character, std::uint32_t samples) {
        const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
        ViewFrame view = test::framed_view(character, offscreen);
        OrbitCamera camera = character.framing(1);
        camera.distance *= 0.83F;
        camera.yaw_radians = camera.pitch_radians = 0.25F;  // no edge stands upright between two columns of pixels
        view.camera = camera.camera(1);
        view.samples = samples;
        return test::draw(character, offscreen, view);
    }
    Portrait with(Face face, const std::string& name = {}, const std::string& value = {}) {
        Portrait character = make_character(std::move(face));
        EXPECT_TRUE(character.set("scattering.millimetres_a_unit", "1000"));
        EXPECT_TRUE(character.set("shadows.method", "off"));  // a card hides light from skin beside it
        if (!name.empty()) {
            EXPECT_TRUE(character.set(name, value));
        }
        return character;
    }
    /// Of each pixel: whether it is the same in both, to the bit or within `tolerance`.
    static std::vector<bool> same(const Image& a, const Image& b, float tolerance = 0) {
        std::vector<bool> equal;
        for (std::size_t p = 0; p < a.floats.size(); p += 4) {
            equal.push_back(std::equal(&a.floats[p], &a.floats[p] + 4, &b.floats[p],
                                       [=](float x, float y) { return std::abs(x - y) <= tolerance; }));
        }
        return equal;
    }
};

TEST_F(Parts, ACardGivesSkinNothingAndTakesNothingFromIt) {
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        Face bald = card_before_skin(mode);
        bald.primitives[1].index_count = 0;
        Face bright = card_before_skin(mode);
        bright.materials[1].emissive_linear = glm::vec3(30);
        Portrait card = with(card_before_skin(mode)), bright_card = with(bright),
                 bald_plain = with(bald, "scattering.method", "off");
        for (const std::uint32_t samples : {1U, 4U}) {
            const Image image = draw(card, samples);
            ASSERT_TRUE(card.set("scattering.method", "off"));
            const Image unscattered = draw(card, samples);
            ASSERT_TRUE(card.set("scattering.method", "separable"));
            ASSERT_TRUE(card.set("parts.hair", "plain"));
            const Image plain = draw(card, samples);
            ASSERT_TRUE(card.set("parts.hair", "strands"));
            // Where the head is as it is without its card, the card covers nothing.
            const std::vector<bool> no_card = same(draw(bald_plain, samples), unscattered);
            const std::vector<bool> as_bright = same(image, draw(bright_card, samples)),
                                    as_unscattered = same(image, unscattered),
                                    // Shaded as hair, what blends by less than 1 / 255 is left out.
                as_plain = same(image, plain, mode == AlphaMode::blend ? 1.0F / 255 : 0);
            std::size_t skin = 0, hair = 0, changed_hair = 0;
            for (std::size_t p = 0; p < no_card.size(); ++p) {
                if (no_card[p]) {
                    ++skin;
                    ASSERT_TRUE(as_bright[p]) << "light of a card reaches skin beside it, pixel " << p;
                    // With samples, a soft edge and a hard one need not touch the same pixels.
                    ASSERT_TRUE(as_plain[p] || samples > 1) << "the shading of hair changes skin, pixel " << p;
                    continue;
                }
                ++hair;
                if (mode != AlphaMode::blend && samples == 1) {
                    ASSERT_TRUE(as_unscattered[p]) << "scattering changes a card, pixel " << p;
                    changed_hair += as_plain[p] ? 0U : 1U;
                }
            }
            EXPECT_GT(skin, 1000U);
            EXPECT_GT(hair, 300U);
            if (mode != AlphaMode::blend && samples == 1) {
                EXPECT_GT(changed_hair, 300U);
            }
        }
    }
}

TEST_F(Parts, CutOutStrandsHaveSoftEdgesWithSamples) {
    Portrait character = with(card_before_skin(AlphaMode::mask));
    // Different values in each row, summed over rows: a soft edge has some that neither side of it has.
    const auto greys = [&](std::uint32_t samples) {
        const Image image = draw(character, samples);
        std::size_t sum = 0;
        for (std::uint32_t y = 20; y < 60; ++y) {
            std::set<int> found;
            for (std::uint32_t x = 36; x < 60; ++x) {
                const float value = image.floats.at(4 * (std::size_t{y} * side + x));
                found.insert(static_cast<int>(std::lround(200 * static_cast<double>(value))));
            }
            sum += found.size();
        }
        return sum;
    };
    const std::size_t hard = greys(1);
    EXPECT_GT(greys(4), hard + 12) << "one more in a third of the rows";
}

/// A second card halfway to the skin, after the first in the file's order, whose strand is of the other colour.
Face two_cards() {
    Face face = card_before_skin(AlphaMode::blend);
    for (std::size_t p = 0; p < 256; ++p) {
        if (p % 16 / 4 == 2) face.images[0].bytes[4 * p] = 250;
    }
    const auto first = static_cast<std::uint32_t>(face.positions.size());
    const auto first_index = static_cast<std::uint32_t>(face.indices.size());
    for (std::uint32_t v = first - 4; v < first; ++v) {
        face.positions.push_back(face.positions[v] - glm::vec3(0, 0, 0.002F));
        face.normals.push_back(face.normals[v]);
        face.tangents.push_back(face.tangents[v]);
        face.uv0.emplace_back(0.625F, 0.5F);
        face.uv1.emplace_back(0);
    }
    face.indices.insert(face.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    test::add_primitive(face, first, first_index);
    face.primitives.back().material = 1;
    face.meshes[0].primitive_count = 3;
    return face;
}

TEST_F(Parts, ANearerStrandHidesOneThatTheFileHasLater) {
    Face without = two_cards();
    without.primitives[2].index_count = 0;
    Portrait one = with(without, "shadows.method", "off"), two = with(two_cards(), "shadows.method", "off");
    const Image image = draw(one, 1);
    const std::vector<bool> unchanged = same(image, draw(two, 1));
    std::size_t changed = 0;
    for (std::size_t x = 36; x < 52; ++x) changed += unchanged[32 * side + x] ? 0U : 1U;
    EXPECT_GT(changed, 2U) << "the second card is seen between the strands of the first";
    EXPECT_LT(changed, 12U) << "and nowhere else";
}

TEST_F(Parts, OpaqueStrandsCastShadows) {
    Face bald = card_before_skin(AlphaMode::blend);
    bald.primitives[1].index_count = 0;
    Portrait card = with(card_before_skin(AlphaMode::blend), "shadows.method", "off"),
             none = with(bald, "shadows.method", "off");
    const std::vector<bool> beside = same(draw(card, 1), draw(none, 1));
    ASSERT_TRUE(card.set("shadows.method", "maps"));
    ASSERT_TRUE(none.set("shadows.method", "maps"));
    const Image shadowed = draw(card, 1), lit = draw(none, 1);
    std::size_t darker = 0;
    for (std::size_t p = 0; p < beside.size(); ++p) {
        if (beside[p] && shadowed.floats[4 * p] < 0.9F * lit.floats[4 * p]) ++darker;
    }
    EXPECT_GT(darker, 20U);
}

/// Two balls in a plate of skin with a round hole for each.
Face two_eyes() {
    Face face;
    face.path = "test";
    const auto vertex = [&face](glm::vec3 position, glm::vec3 normal, glm::vec2 uv) {
        face.positions.push_back(position);
        face.normals.push_back(normal);
        face.tangents.emplace_back(1, 0, 0, 1);
        face.uv0.push_back(uv);
        face.uv1.emplace_back(0);
    };
    const auto quads = [&face](std::uint32_t first, std::uint32_t rings, std::uint32_t around) {
        for (std::uint32_t r = 0; r + 1 < rings; ++r) {
            for (std::uint32_t k = 0; k < around; ++k) {
                const std::uint32_t a = first + r * around + k, b = first + r * around + (k + 1) % around;
                face.indices.insert(face.indices.end(), {a, a + around, b + around, a, b + around, b});
            }
        }
    };
    constexpr std::uint32_t around = 32;
    constexpr float pi = 3.14159265F;
    for (int kind = 0; kind < 2; ++kind) {
        const auto first = static_cast<std::uint32_t>(face.positions.size());
        const auto first_index = static_cast<std::uint32_t>(face.indices.size());
        for (const float x : {-0.032F, 0.032F}) {
            const auto begin = static_cast<std::uint32_t>(face.positions.size());
            const std::uint32_t rings = kind == 0 ? 24 : 6;
            for (std::uint32_t r = 0; r < rings; ++r) {
                for (std::uint32_t k = 0; k < around; ++k) {
                    const float turn = 2 * pi * static_cast<float>(k) / around;
                    const glm::vec2 direction(std::cos(turn), std::sin(turn));
                    if (kind == 0) {
                        const float polar = 1e-3F + 0.5F * pi * static_cast<float>(r) / 23;
                        const glm::vec3 n(direction * std::sin(polar), std::cos(polar));
                        vertex(glm::vec3(x, 0, 0) + 0.012F * n, n, 0.5F + 0.3F * polar * direction);
                    } else {
                        const glm::vec2 p = (0.008F + 0.004F * static_cast<float>(r)) * direction;
                        vertex({x + p.x, p.y, 0.0105F}, {0, 0, 1}, glm::vec2(0.5F));
                    }
                }
            }
            quads(begin, rings, around);
        }
        test::add_primitive(face, first, first_index);
        face.primitives.back().material = kind;
        Material material;
        material.name = kind == 0 ? "eye" : "skin";
        material.metallic = 0;
        face.materials.push_back(material);
    }
    Image rings;  // an iris with a pupil: grey rings
    rings.width = rings.height = 64;
    rings.channels = 3;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double r = std::hypot(x - 31.5, y - 31.5);
            const auto grey = static_cast<std::uint8_t>(r < 4 ? 10 : r < 10 ? 120 : 230);
            rings.bytes.insert(rings.bytes.end(), {grey, grey, grey});
        }
    }
    face.images.push_back(rings);
    face.materials[0].base_color_srgb.image = 0;
    face.meshes.push_back({"mesh", 0, 2});
    Node node;
    node.mesh = 0;
    face.nodes.push_back(node);
    return face;
}

TEST_F(Parts, FindsEyesAndTheEdgesOfTheirLids) {
    const Face face = two_eyes();
    ASSERT_TRUE(validate(face));
    const EyeSockets sockets = find_eye_sockets(face, material_kinds(face));
    ASSERT_EQ(sockets.eyes.size(), 2U);
    EXPECT_NEAR(sockets.eyes[0].centre.x, -0.032F, 1e-4F);
    EXPECT_NEAR(sockets.eyes[1].radius, 0.012F, 1e-4F);
    EXPECT_NEAR(face.positions[sockets.eyes[1].pole].x, 0.032F, 1e-4F);
    ASSERT_EQ(sockets.lids.size(), 2U);
    for (const std::uint32_t v : sockets.lids[1].upper) {
        EXPECT_NEAR(glm::length(glm::vec2(face.positions[v]) - glm::vec2(0.032F, 0)), 0.008F, 1e-4F);
        EXPECT_GE(face.positions[v].y, -1e-4F);
    }
}

TEST_F(Parts, EyesAreDarkerBelowTheirUpperLidAndTheIrisLiesDeep) {
    Lighting sky;
    sky.sky_radiance_linear = sky.ground_radiance_linear = glm::vec3(1);
    const Offscreen offscreen = make_offscreen(160, 80, Output::linear_hdr);
    const auto picture = [&](const char* name, const char* value, float yaw) {
        Portrait character = with(two_eyes(), name, value);
        ViewFrame view = test::framed_view(character, offscreen);
        const glm::vec3 from(0.1F * std::sin(yaw), 0, 0.1F * std::cos(yaw));
        view.camera.view_from_world = glm::lookAt(from, glm::vec3(0), glm::vec3(0, 1, 0));
        view.camera.clip_from_view = glm::ortho(-0.048F, 0.048F, -0.024F, 0.024F, 0.01F, 0.3F);
        view.lighting = &sky;
        view.samples = 1;
        return test::draw(character, offscreen, view);
    };
    const Image shaded = picture("parts.iris_depth", "1", 0), plain = picture("parts.lid_shade", "0", 0);
    // Down the middle column of an eye: its rim of sclera above, and the same distance below.
    double upper = 1, lower = 1;
    for (std::uint32_t y = 0; y < 80; ++y) {
        for (std::uint32_t x = 0; x < 160; ++x) {
            const std::size_t at = 4 * (std::size_t{y} * 160 + x);
            const double share = static_cast<double>(shaded.floats[at]) / static_cast<double>(plain.floats[at]);
            ASSERT_LE(share, 1.001);
            if (x < 128 || x > 138) continue;  // away from the eye's corners, where both lids meet
            (y < 40 ? upper : lower) = std::min(y < 40 ? upper : lower, share);
        }
    }
    EXPECT_LT(upper, 0.6);
    EXPECT_LT(upper, lower - 0.1);
    EXPECT_LT(lower, 0.9);
    // Seen straight on, the refracted iris lies where it is painted, but for the middle's magnification; from the side
    // it does not.
    const auto difference = [](const Image& a, const Image& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.floats.size(); ++i)
            sum += std::abs(static_cast<double>(a.floats[i] - b.floats[i]));
        return sum;
    };
    const double straight = difference(shaded, picture("parts.iris_depth", "0", 0));
    const double aside = difference(picture("parts.iris_depth", "1", 0.8F), picture("parts.iris_depth", "0", 0.8F));
    EXPECT_GT(aside, 1.5 * straight);
    EXPECT_GT(aside, 5);
}

}  // namespace
}  // namespace blush
