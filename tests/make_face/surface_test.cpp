/// The face's surface: its colour follows from its pigments, its cards move with the skin, its maps have no seams and
/// are the same from any number of threads.

#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rig/blood/colour_difference.h"
#include "runtime/files/appearance_file.h"
#include "runtime/files/face_appearance.h"
#include "runtime/files/face_file.h"
#include "tools/make_face/brow_cards.h"
#include "tools/make_face/build_face.h"
#include "tools/make_face/expressions.h"
#include "tools/make_face/face_command.h"
#include "tools/make_face/hair.h"
#include "tools/make_face/hair_cards.h"
#include "tools/make_face/parallel.h"
#include "tools/make_face/pigments.h"
#include "tools/make_face/skin_detail.h"
#include "tools/make_face/strands.h"

namespace blush::make_face {
namespace {

constexpr int side = 160;

const Head& head() {
    static const Head made = [] {
        Head h = make_head(6'000);
        grow_hair(h);
        return h;
    }();
    return made;
}

const SurfaceTexels& texels() {
    static const SurfaceTexels made(head(), side);
    return made;
}

const SkinColourTable& table() {
    static const SkinColourTable made;
    return made;
}

SkinTone dark_skin() {
    SkinTone tone;
    tone.melanin = 0.25;
    return tone;
}

/// The texel whose place is nearest to `place`.
std::size_t texel_at(const Vec3& place) {
    std::size_t best = 0;
    double least = 1e9;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const SurfaceTexel& t = texels().at(x, y);
            if (!t.covered || t.part != Part::skin || glm::distance(t.place(), place) >= least) continue;
            least = glm::distance(t.place(), place);
            best = static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x);
        }
    }
    return best;
}

TEST(Pigments, GiveTheBaseColourWithinItsEightBits) {
    for (SkinTone tone : {SkinTone{}, dark_skin()}) {
        const AppearanceMaps maps = paint_pigments(texels(), tone, table());
        const Picture color = base_color(maps, table());
        const ColourMap again = recomposed(maps, table());
        double sum = 0, most = 0;
        for (std::size_t k = 0; k < again.values.size(); ++k) {
            const auto channel = [&](std::size_t c) {
                return static_cast<float>(linear_from_srgb(color.bytes[3 * k + c] / 255.0));
            };
            const double d = ciede2000_of_srgb_linear(again.values[k], {channel(0), channel(1), channel(2)});
            sum += d;
            most = std::max(most, d);
        }
        std::printf("CIEDE2000 to the base colour: %.3f mean, %.3f most\n", sum / (side * side), most);
        EXPECT_LT(sum / (side * side), 0.3);
        EXPECT_LT(most, 1.0);  // half a step of 8 bits in the dark of the mouth
    }
}

TEST(Pigments, AreWrittenBesideTheFaceThatTheyColour) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(testing::TempDir()) / "blush_make_face_maps";
    fs::remove_all(folder);
    fs::create_directories(folder);
    FaceCommand command;
    command.output = (folder / "head.glb").string();
    command.vertices = 5'000;
    command.texture_side = 64;
    command.maps = true;
    const Status written = command.run(fs::path(BLUSH_SOURCE_DIR) / "assets" / "presets");
    ASSERT_TRUE(written) << written.error().message;
    const Result<FaceAppearance> appearance = load_face_appearance(appearance_folder(command.output));
    ASSERT_TRUE(appearance) << appearance.error().message;
    ASSERT_TRUE(appearance->pigments);
    EXPECT_TRUE(std::ranges::equal(appearance->pigments->blood.names, hemoglobin_pattern_names));
    const Result<Face> face = load_face(command.output);
    ASSERT_TRUE(face) << face.error().message;
    const Image& texture = face->images[static_cast<std::size_t>(face->materials[0].base_color_srgb.image)];
    const ColourMap painted = *colour_map_of(texture, "texture"),
                    again = recomposed(appearance->pigments->maps, table());
    ASSERT_TRUE(painted.same_size(again));
    double sum = 0;
    for (std::size_t k = 0; k < again.values.size(); ++k)
        sum += ciede2000_of_srgb_linear(again.values[k], painted.values[k]);
    EXPECT_LT(sum / static_cast<double>(again.values.size()), 0.3) << "the residual is stored as half floats";
    fs::remove_all(folder);
}

TEST(Pigments, HoldOnlyWhatTheirFilesCanStore) {
    const AppearanceMaps maps = paint_pigments(texels(), {}, table());
    for (std::size_t k = 0; k < maps.melanin.values.size(); ++k) {
        const float m = maps.melanin.values[k], h = maps.hemoglobin.values[k];
        ASSERT_EQ(m, stored_fraction(stored_byte(m, largest_melanin), largest_melanin));
        ASSERT_EQ(h, stored_fraction(stored_byte(h, largest_hemoglobin), largest_hemoglobin));
    }
}

TEST(Pigments, BloodStandsWhereFacesAreRed) {
    const AppearanceMaps maps = paint_pigments(texels(), {}, table());
    const auto blood = [&](const Vec3& place) { return maps.hemoglobin.values[texel_at(place)]; };
    const float brow = blood({20, 50, 88});
    EXPECT_GT(blood({40, -34, 66}), 1.3F * brow) << "cheek";
    EXPECT_GT(blood({0, -37, 112}), 1.3F * brow) << "tip of the nose";
    EXPECT_GT(blood({0, -75, 96}), 2.0F * brow) << "lip";
    EXPECT_LT(maps.skin.values[texel_at({0, 120, -5})], 0.1F) << "hair does not flush";
    EXPECT_GT(maps.skin.values[texel_at({40, -34, 66})], 0.95F);
}

TEST(Pigments, DarkerSkinIsDarkerEverywhere) {
    const Picture light = base_color(paint_pigments(texels(), {}, table()), table()),
                  dark = base_color(paint_pigments(texels(), dark_skin(), table()), table());
    for (const Vec3 place : {Vec3(20, 50, 88), Vec3(40, -34, 66), Vec3(0, -37, 112), Vec3(0, -75, 96)}) {
        const std::size_t k = 3 * texel_at(place);
        EXPECT_LT(dark.bytes[k], light.bytes[k]);
        EXPECT_LT(dark.bytes[k + 1], light.bytes[k + 1]);
    }
}

TEST(Texels, AreTheSameFromOneThreadAsFromTwo) {
    const auto everything = [] {
        const SurfaceTexels some(head(), 96);
        const AppearanceMaps maps = paint_pigments(some, {}, table());
        std::vector<unsigned char> bytes = base_color(maps, table()).bytes;
        for (const Picture& picture : {paint_relief(some), paint_roughness(some), paint_specular(some)})
            bytes.insert(bytes.end(), picture.bytes.begin(), picture.bytes.end());
        return bytes;
    };
    most_threads = 1;
    const auto alone = everything();
    most_threads = 2;
    const auto paired = everything();
    most_threads = 3;
    EXPECT_EQ(alone, paired);
    EXPECT_EQ(alone, everything());
    most_threads = 16;
}

/// Bilinear, in steps of 255.
Vec3 filtered(const Picture& picture, const Vec2& uv) {
    const int width = picture.width;
    const Vec2 q = uv * static_cast<double>(width) - 0.5, low = glm::floor(q), f = q - low;
    Vec3 sum(0);
    for (int n = 0; n < 4; ++n) {
        const int dx = n & 1, dy = n >> 1;
        const int x = std::clamp(static_cast<int>(low.x) + dx, 0, width - 1),
                  y = std::clamp(static_cast<int>(low.y) + dy, 0, width - 1);
        const unsigned char* t = &picture.bytes[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                                     static_cast<std::size_t>(x))];
        sum += (dx ? f.x : 1 - f.x) * (dy ? f.y : 1 - f.y) * Vec3(t[0], t[1], t[2]);
    }
    return sum;
}

TEST(Texels, ColoursMeetAtTheSeams) {
    // Vertices of one place that stand on both sides of a seam: what is filtered there must be nearly one colour, since
    // it is a function of the place and the charts' margins continue them.
    const Picture color = base_color(paint_pigments(SurfaceTexels(head(), 512), {}, table()), table());
    double sum = 0;
    int count = 0;
    for (Index v = 0; v < head().weld.size(); ++v) {
        const Index other = head().weld[v];
        if (other == v || glm::distance(head().mesh.uv[v], head().mesh.uv[other]) < 0.05) continue;
        const Vec3 d = glm::abs(filtered(color, head().mesh.uv[v]) - filtered(color, head().mesh.uv[other]));
        sum += (d.x + d.y + d.z) / 3;
        ++count;
    }
    std::printf("%.2f steps of 255 over %d places on seams\n", sum / count, count);
    ASSERT_GT(count, 20);
    EXPECT_LT(sum / count, 5);
}

TEST(Texels, MarginsContinueTheCharts) {
    // Bilinear filtering at a chart's edge reads the texel beside it.
    const AppearanceMaps maps = paint_pigments(texels(), dark_skin(), table());
    for (int y = 1; y + 1 < side; ++y) {
        for (int x = 1; x + 1 < side; ++x) {
            if (texels().at(x, y).covered) continue;
            for (const glm::ivec2 d : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
                if (!texels().at(x + d.x, y + d.y).covered) continue;
                const auto k = static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x);
                ASSERT_NE(maps.residual.values[k], glm::vec3(1)) << "bare beside a chart at " << x << ", " << y;
            }
        }
    }
}

TEST(Relief, IsFinestAboutTheEyeAndUprightOnTheLips) {
    const Picture relief = paint_relief(SurfaceTexels(head(), 512));
    const SurfaceTexels fine(head(), 512);
    double across = 0, along = 0;
    for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 512; ++x) {
            const SurfaceTexel& t = fine.at(x, y);
            const bool lower_lip = t.covered && t.part == Part::skin && glm::distance(t.place(), Vec3(0, -75, 96)) < 5;
            if (!lower_lip) continue;
            const std::size_t k = 3 * (static_cast<std::size_t>(y) * 512 + static_cast<std::size_t>(x));
            across += std::abs(relief.bytes[k] - 127.5);
            along += std::abs(relief.bytes[k + 1] - 127.5);
        }
    }
    EXPECT_GT(across, 1.5 * along) << "furrows of the lips stand upright: slopes lie across";
}

TEST(HairCards, StandOnTheScalpWithinTheirBudget) {
    const HairCards cards = make_hair_cards();
    EXPECT_LE(cards.mesh.positions.size(), 16'000U);
    std::printf("%zu vertices, %zu triangles\n", cards.mesh.positions.size(), cards.mesh.triangles.size());
    EXPECT_GE(cards.mesh.positions.size(), 3'000U);
    for (std::size_t v = 0; v < cards.roots.size(); ++v) {
        ASSERT_GT(above_hairline(cards.roots[v]), -3);
        ASSERT_LT(glm::distance(cards.roots[v], cards.mesh.positions[v]), 85);
        ASSERT_NEAR(glm::length(cards.mesh.normals[v]), 1, 1e-9);
    }
}

TEST(BrowCards, FollowTheSkinInEveryTarget) {
    const std::vector<ShapeTarget> targets = head_targets(head());
    const BrowCards brows = make_brow_cards(head());
    const std::vector<ShapeTarget> carried = carried_targets(brows.mesh, brows.anchors, head(), targets);
    const auto height = [&](std::size_t v, const ShapeTarget* skin, const ShapeTarget* card) {
        const SkinAnchor& anchor = brows.anchors[v];
        Vec3 on_skin = anchor.interpolated(head().mesh.positions), p = brows.mesh.positions[v];
        if (skin) on_skin += anchor.interpolated(skin->position_deltas);
        if (card) p += card->position_deltas[v];
        return glm::distance(on_skin, p);
    };
    std::size_t moving = 0;
    for (const ShapeTarget& source : targets) {
        const auto found = std::ranges::find(carried, source.name, &ShapeTarget::name);
        const ShapeTarget* card = found == carried.end() ? nullptr : &*found;
        moving += card != nullptr ? 1 : 0;
        for (std::size_t v = 0; v < brows.anchors.size(); ++v) {
            ASSERT_NEAR(height(v, &source, card), height(v, nullptr, nullptr), 0.02) << source.name;
        }
    }
    EXPECT_GE(moving, 5U);
    for (std::size_t v = 0; v < brows.anchors.size(); ++v) ASSERT_LT(height(v, nullptr, nullptr), 1.2);
}

TEST(Strands, BareTexelsHaveTheStrandsColour) {
    const Picture hair = paint_hair_strands(128);
    double bare = 0, covered = 0;
    int bare_count = 0, covered_count = 0;
    for (int y = 0; y < 128; ++y) {  // the upper half: as the light falls on it
        for (int x = 0; x < 128; ++x) {
            const unsigned char* t = hair.bytes.data() + 4 * (y * 128 + x);
            (t[3] < 5 ? bare : covered) += t[0];
            (t[3] < 5 ? bare_count : covered_count) += 1;
        }
    }
    ASSERT_GT(bare_count, 100);
    ASSERT_GT(covered_count, 100);
    EXPECT_NEAR(bare / bare_count, covered / covered_count, 25) << "a fringe of another colour";
}

}  // namespace
}  // namespace blush::make_face
