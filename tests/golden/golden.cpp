// Pictures that were looked at once, and must stay as they were. docs/golden_images.md says how to bless new ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "runtime/files/image_file.h"
#include "runtime/files/output_file.h"
#include "tests/gl_fixture.h"
#include "tests/rotation.h"

namespace blush {
namespace {

namespace fs = std::filesystem;

/// How far a picture may be from its golden one, and why.
struct Bounds {
    int worst_difference;         ///< of any channel of any pixel, of 255
    double most_differing_share;  ///< of pixels that differ by more than `unseen`
    const char* why;
};
/// A difference this small in 8 bits is rounding, and nobody sees it.
constexpr int unseen = 2;

struct Difference {
    int worst = 0;
    double differing_share = 0;
};

/// Both pictures have four channels.
Difference difference_of(const Image& a, const Image& b) {
    Difference difference;
    const std::size_t pixels = a.bytes.size() / 4;
    for (std::size_t p = 0; p < pixels; ++p) {
        int worst = 0;
        for (std::size_t c = 0; c < 4; ++c) worst = std::max(worst, std::abs(a.bytes[4 * p + c] - b.bytes[4 * p + c]));
        difference.worst = std::max(difference.worst, worst);
        if (worst > unseen) difference.differing_share += 1.0 / static_cast<double>(pixels);
    }
    return difference;
}

bool within(const Difference& difference, const Bounds& bounds) {
    return difference.worst <= bounds.worst_difference && difference.differing_share <= bounds.most_differing_share;
}

Image read_png(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    std::uint64_t limit = 1 << 26;
    return load::decode_image(bytes, 4096, limit, path.string());
}

class Golden : public test::GlTest {
protected:
    void expect_golden(const std::string& name, const Image& image, const Bounds& bounds) {
        ASSERT_GE(test::colour_count(image), test::fewest_colours) << "the picture is blank";
        const fs::path golden = fs::path(BLUSH_SOURCE_DIR) / "tests/golden" / (name + ".png");
        if (std::getenv("BLUSH_BLESS") != nullptr) {
            const Status written = write_image(golden, image);
            ASSERT_TRUE(written) << written.error().message;
            std::cout << "blessed " << golden.string() << "\n";
            return;
        }
        ASSERT_TRUE(fs::exists(golden)) << golden << " is missing; docs/golden_images.md says how to make it";
        const Image expected = read_png(golden);
        ASSERT_EQ(expected.width, image.width);
        ASSERT_EQ(expected.height, image.height);
        ASSERT_EQ(expected.channels, 4U);
        ASSERT_GE(test::colour_count(expected), test::fewest_colours) << "the golden picture is blank";
        const Difference difference = difference_of(image, expected);
        if (within(difference, bounds)) return;
        const fs::path folder = fs::path(BLUSH_BINARY_DIR) / "golden_failed";
        fs::create_directories(folder);
        const Status written = write_image(folder / (name + ".png"), image);
        ADD_FAILURE() << name << ": worst difference " << difference.worst << " of " << bounds.worst_difference << ", "
                      << difference.differing_share * 100 << " % of pixels differ of "
                      << bounds.most_differing_share * 100 << " % (" << bounds.why << "); what came out is in "
                      << (written ? (folder / (name + ".png")).string() : written.error().message);
    }
    Image picture(Face face, const std::vector<float>& weights, float yaw_radians) {
        Portrait character = make_character(std::move(face));
        test::set_weights(character, weights);
        // The dome is a sheet that light from behind shines through; these pictures are of its front.
        EXPECT_TRUE(character.set("translucency.strength", "0"));
        const Offscreen offscreen = make_offscreen(128, 128);
        ViewFrame view = test::framed_view(character, offscreen);
        OrbitCamera camera = character.framing(1);
        camera.yaw_radians = yaw_radians;
        view.camera = camera.camera(1);
        return test::draw(character, offscreen, view);
    }
};

// Both scenes are smooth and lit by three fixed lights, so that a rasteriser's freedom shows in two places only.
constexpr Bounds bounds = {
    96, 0.02,
    "a sample on the outline, 4 a pixel, may fall on either side (a quarter of the step from face to background and "
    "more "
    "where the curve is steep), and the outline is about 2 % of the pixels; inside it a driver's own rounding of "
    "divisions and roots stays below 2 of 255"};

Face moved_face() { return test::make_face({.side = 40, .targets = 4, .seam = true, .normal_map = true, .seed = 11}); }

TEST_F(Golden, TurnedNormalsUnderANormalMap) {
    expect_golden("turned_normals", picture(moved_face(), {1, 0.8F, -1, 0.6F}, 0.5F), bounds);
}

TEST_F(Golden, JointsAndABlendedHalf) {
    Face face =
        test::make_face({.side = 40, .targets = 2, .normal_deltas = true, .two_primitives = true, .joints = true});
    face.materials.push_back(face.materials[0]);
    face.materials[1].alpha_mode = AlphaMode::blend;
    face.materials[1].base_color_linear = {0.2F, 0.4F, 0.9F, 0.5F};
    face.primitives[1].material = 1;
    face.nodes[1].rest.rotation = rotation_of(glm::angleAxis(0.5F, glm::vec3(1, 0, 0)));
    expect_golden("joints_and_blending", picture(std::move(face), {1, 1}, -0.4F), bounds);
}

TEST_F(Golden, FourPlacesOfSmaaOverTwoFrames) {
    Portrait character = make_character(moved_face());
    ASSERT_TRUE(character.set("antialiasing.mode", "smaa_4x"));
    test::set_weights(character, {1, 0.8F, -1, 0.6F});
    const Offscreen offscreen = make_offscreen(128, 128);
    ViewFrame view = test::framed_view(character, offscreen);
    OrbitCamera camera = character.framing(1);
    camera.yaw_radians = 0.5F;
    view.camera = camera.camera(1);
    test::draw(character, offscreen, view);
    expect_golden("smaa_4x", test::draw(character, offscreen, view), bounds);
}

// Whole emotions on the default face: shape, folds and blood together.
constexpr Bounds emotion_bounds = {
    128, 0.02,
    "hair, brows and lashes are thinner than a pixel, and a sample of 4 on one of their edges may fall on either side "
    "(up "
    "to half of the step from dark hair to lit skin); such pixels are about 2 % of the picture, and skin between them "
    "only rounds"};

class GoldenEmotions : public Golden {
protected:
    GoldenEmotions() : character_(loaded()), offscreen_(make_offscreen(width, height)) {
        view_ = offscreen_.view();
        constexpr float aspect = static_cast<float>(width) / height;
        view_.camera = character_.framing(aspect).camera(aspect);
    }
    Image picture(const char* emotion, float strength) {
        std::ranges::fill(character_.controls(), 0.0F);
        character_.set(*character_.control(emotion), strength);
        return test::draw(character_, offscreen_, view_);
    }
    Portrait loaded() {
        Result<Portrait> character = Portrait::load(device_, fs::path(BLUSH_BINARY_DIR) / "assets/face.glb");
        EXPECT_TRUE(character) << character.error().message;
        return *std::move(character);
    }
    static constexpr std::uint32_t width = 192, height = 224;
    Portrait character_;
    Offscreen offscreen_;
    ViewFrame view_;
};

TEST_F(GoldenEmotions, AngerAndFearByHalfAndInFull) {
    expect_golden("anger_half", picture("anger", 0.5F), emotion_bounds);
    expect_golden("anger", picture("anger", 1), emotion_bounds);
    expect_golden("fear_half", picture("fear", 0.5F), emotion_bounds);
    const Image fear = picture("fear", 1);
    expect_golden("fear", fear, emotion_bounds);
    // The bounds tell the same face without its blood, and without its shape, apart.
    ASSERT_TRUE(character_.set("blood.shown", "no"));
    EXPECT_FALSE(within(difference_of(fear, picture("fear", 1)), emotion_bounds));
    ASSERT_TRUE(character_.set("blood.shown", "yes"));
    EXPECT_FALSE(within(difference_of(fear, picture("fear", 0.9F)), emotion_bounds));
}

TEST_F(Golden, TheBoundsTellAnotherFaceApart) {
    const Image golden = picture(moved_face(), {1, 0.8F, -1, 0.6F}, 0.5F);
    EXPECT_TRUE(within(difference_of(golden, golden), bounds));
    const Image without_one_target = picture(moved_face(), {1, 0.8F, -1, 0}, 0.5F);
    EXPECT_FALSE(within(difference_of(golden, without_one_target), bounds));
    Face flat = moved_face();
    flat.materials[0].normal.image = -1;
    EXPECT_FALSE(within(difference_of(golden, picture(flat, {1, 0.8F, -1, 0.6F}, 0.5F)), bounds));
}

}  // namespace
}  // namespace blush
