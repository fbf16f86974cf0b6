// Each emotion on the default face with and without wrinkles and blood: the frames differ where the face folds and
// flushes, and nowhere else. Places are those of the mean face (rig/head/canonical_face.h).

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "rig/blood/colour_difference.h"
#include "rig/head/canonical_face.h"
#include "rig/wrinkles/wrinkle_zones.h"
#include "runtime/files/face_file.h"
#include "runtime/frame/frame_state.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

constexpr std::uint32_t width = 150, height = 170;
constexpr std::array<const char*, 6> emotions = {"joy", "sadness", "anger", "fear", "disgust", "surprise"};

/// What a pixel shows of the face: the place on the mean face of the nearest vertex of its skin.
struct Pixels {
    std::vector<glm::vec2> canonical_mm;
    std::vector<bool> skin;
};

struct Drawn {
    Image image;
    Pixels pixels;
};

class EmotionFrames : public test::GlTest {
protected:
    static void SetUpTestSuite() {
        const std::filesystem::path path = std::filesystem::path(BLUSH_BINARY_DIR) / "assets/face.glb";
        Result<Face> face = load_face(path);
        ASSERT_TRUE(face) << face.error().message;
        face_ = new Face(*std::move(face));
        Result<FaceAppearance> appearance = load_face_appearance(appearance_folder(path));
        ASSERT_TRUE(appearance) << appearance.error().message;
        ASSERT_TRUE(appearance->wrinkles && appearance->pigments) << "the default face has no maps beside it";
        appearance_ = new FaceAppearance(*std::move(appearance));
    }
    static void TearDownTestSuite() {
        delete face_;
        delete appearance_;
    }

    EmotionFrames() : character_(make_character(*face_)), offscreen_(make_offscreen(width, height)) {
        character_.set_appearance(*appearance_);
        // Only what is compared: other effects would spread it over pixels.
        EXPECT_TRUE(character_.set("scattering.method", "off"));
        // And what costs time, and neither folds nor flushes.
        EXPECT_TRUE(character_.set("shadows.method", "off"));
        EXPECT_TRUE(character_.set("antialiasing.mode", "none"));
        view_ = offscreen_.view();
        constexpr float aspect = static_cast<float>(width) / height;
        OrbitCamera camera = character_.framing(aspect);
        camera.distance *= 0.8F;
        // The shoulders' vertices lie too far apart to tell skin by them.
        camera.target_world.y += static_cast<double>(0.04F * camera.distance);
        view_.camera = camera.camera(aspect);
    }

    void feel(const char* emotion, float strength) {
        std::ranges::fill(character_.controls(), 0.0F);
        character_.set(*character_.control(emotion), strength);
    }
    Image drawn(const char* wrinkles, const char* blood) {
        EXPECT_TRUE(character_.set("wrinkles.shown", wrinkles));
        EXPECT_TRUE(character_.set("blood.shown", blood));
        return test::draw(character_, offscreen_, view_);
    }

    /// Of the pose that was drawn last.
    Pixels pixels() {
        CharacterState& state = character_.state();
        const std::vector<std::uint32_t> skin = skin_primitives(*face_);
        const CanonicalFrame frame(*landmarks_from_targets(*face_, skin));
        const Scene::Surface surface = character_.read_deformed();
        Pixels result{std::vector<glm::vec2>(width * height, glm::vec2(1e9F)),
                      std::vector<bool>(width * height, false)};
        std::vector<float> depth(width * height, 1e9F);
        const glm::mat4 clip_from_world = view_.camera.clip_from_view * glm::mat4(view_.camera.view_from_world);
        for (std::size_t n = 0; n < face_->nodes.size(); ++n) {
            const Node& node = face_->nodes[n];
            if (node.mesh < 0) continue;
            const Mesh& mesh = face_->meshes[static_cast<std::size_t>(node.mesh)];
            for (const std::uint32_t p : skin) {
                if (p < mesh.first_primitive || p >= mesh.first_primitive + mesh.primitive_count) continue;
                const Primitive& primitive = face_->primitives[p];
                for (std::uint32_t v = primitive.first_vertex; v < primitive.first_vertex + primitive.vertex_count;
                     ++v) {
                    const glm::vec4 clip = clip_from_world * glm::mat4(state.stance.world_from_node[n]) *
                                           glm::vec4(surface.positions[v], 1);
                    const glm::vec2 place =
                        (glm::vec2(clip.x, -clip.y) / clip.w * 0.5F + 0.5F) * glm::vec2(width, height);
                    splat(result, depth, place, clip.w, frame.canonical_mm(face_->positions[v]));
                }
            }
        }
        return result;
    }

    /// Mean of L*, a*, b* over the pixels within `radius_mm` of a place.
    static glm::dvec3 mean_lab(const Image& image, const Pixels& pixels, glm::vec2 place, float radius_mm) {
        glm::dvec3 sum(0);
        double count = 0;
        for (std::size_t i = 0; i < pixels.skin.size(); ++i) {
            if (!pixels.skin[i] || glm::distance(pixels.canonical_mm[i], place) > radius_mm) continue;
            sum += lab_of(image, i);
            ++count;
        }
        EXPECT_GT(count, 0) << "nothing of the face is at " << place.x << ", " << place.y;
        return sum / std::max(count, 1.0);
    }
    static glm::dvec3 lab_of(const Image& image, std::size_t i) {
        const auto linear = [&](std::size_t c) { return linear_from_srgb(image.bytes[4 * i + c] / 255.0); };
        return lab_from_srgb_linear({linear(0), linear(1), linear(2)});
    }

    /// Vertices of the shoulders are farther apart than their splats reach.
    static bool near_skin(const Pixels& pixels, std::size_t i) {
        constexpr int reach = 4;
        const auto x = static_cast<int>(i % width), y = static_cast<int>(i / width);
        for (int v = std::max(y - reach, 0); v <= std::min(y + reach, static_cast<int>(height) - 1); ++v) {
            for (int u = std::max(x - reach, 0); u <= std::min(x + reach, static_cast<int>(width) - 1); ++u) {
                if (pixels.skin[static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u)]) return true;
            }
        }
        return false;
    }
    static bool same_bits(const Image& a, const Image& b, std::size_t i) {
        return std::equal(&a.bytes[4 * i], &a.bytes[4 * i] + 4, &b.bytes[4 * i]);
    }

    static Face* face_;
    static FaceAppearance* appearance_;
    Portrait character_;
    Offscreen offscreen_;
    ViewFrame view_;

private:
    /// The nearest to the camera of all that come within two pixels.
    static void splat(Pixels& pixels, std::vector<float>& depth, glm::vec2 place, float distance, glm::vec2 mm) {
        constexpr int reach = 2;
        for (int dy = -reach; dy <= reach; ++dy) {
            for (int dx = -reach; dx <= reach; ++dx) {
                const int x = static_cast<int>(std::floor(place.x)) + dx,
                          y = static_cast<int>(std::floor(place.y)) + dy;
                if (x < 0 || y < 0 || x >= static_cast<int>(width) || y >= static_cast<int>(height)) continue;
                const auto i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
                const float away = distance + 1e-4F * static_cast<float>(dx * dx + dy * dy);
                if (away >= depth[i]) continue;
                depth[i] = away;
                pixels.skin[i] = true;
                pixels.canonical_mm[i] = mm;
            }
        }
    }
};

Face* EmotionFrames::face_ = nullptr;
FaceAppearance* EmotionFrames::appearance_ = nullptr;

float distance_from(const WrinkleZonePlace& place, glm::vec2 at) {
    if (place.name.ends_with("Right")) at.x = -at.x;
    const glm::vec2 along = place.to_mm - place.from_mm, off = at - place.from_mm;
    return glm::distance(off, along * std::clamp(glm::dot(off, along) / glm::dot(along, along), 0.0F, 1.0F));
}

// Wider than a zone by a texel of its mask and what the splats blur.
constexpr float margin_mm = 8;

TEST_F(EmotionFrames, WrinklesShowInTheZonesThatActAndNowhereElse) {
    for (const char* emotion : emotions) {
        feel(emotion, 1);
        const Image folded = drawn("yes", "no"), smooth = drawn("no", "no");
        const Pixels seen = pixels();
        std::size_t inside = 0, outside = 0;
        for (std::size_t i = 0; i < seen.skin.size(); ++i) {
            bool expected = false;
            for (std::size_t z = 0; z < wrinkle_zone_places.size() && seen.skin[i]; ++z) {
                const WrinkleZonePlace& place = wrinkle_zone_places[z];
                expected = expected || (character_.pose().wrinkles[z] > 0 &&
                                        distance_from(place, seen.canonical_mm[i]) < place.radius_mm + margin_mm);
            }
            constexpr double noticed = 1;
            if (expected) {
                inside += ciede2000(lab_of(folded, i), lab_of(smooth, i)) > noticed ? 1U : 0U;
            } else {
                outside += same_bits(folded, smooth, i) ? 0U : 1U;
            }
        }
        EXPECT_GT(inside, 40U) << emotion;
        EXPECT_EQ(outside, 0U) << emotion;
        std::printf("%s: %zu pixels fold\n", emotion, inside);
    }
}

TEST_F(EmotionFrames, HalfAnEmotionFoldsLess) {
    for (const char* emotion : emotions) {
        std::array<double, 2> change{};
        for (const bool half : {false, true}) {
            feel(emotion, half ? 0.5F : 1.0F);
            const Image folded = drawn("yes", "no"), smooth = drawn("no", "no");
            for (std::size_t i = 0; i < folded.bytes.size(); ++i)
                change[half ? 1 : 0] += std::abs(folded.bytes[i] - smooth.bytes[i]);
        }
        EXPECT_GT(change[1], 0) << emotion;
        EXPECT_LT(change[1], 0.8 * change[0]) << emotion;
    }
}

TEST_F(EmotionFrames, BloodShowsOnSkinAndNowhereElse) {
    for (const char* emotion : emotions) {
        feel(emotion, 1);
        const Image flushed = drawn("no", "yes"), still = drawn("no", "no");
        const Pixels seen = pixels();
        std::size_t inside = 0, outside = 0;
        for (std::size_t i = 0; i < seen.skin.size(); ++i) {
            if (seen.skin[i]) {
                inside += ciede2000(lab_of(flushed, i), lab_of(still, i)) > 0.7 ? 1U : 0U;
            } else if (!near_skin(seen, i)) {
                outside += same_bits(flushed, still, i) ? 0U : 1U;
            }
        }
        EXPECT_GT(inside, 100U) << emotion;
        EXPECT_EQ(outside, 0U) << emotion;
    }
}

// jimenez-2012, 7.3.1 and 7.7: anger flushes the whole face, fear drains it, a smile fills the cheekbones.
TEST_F(EmotionFrames, BloodGoesWhereTheThesisHasIt) {
    constexpr glm::vec2 cheek_left(45, -28), cheek_right(-45, -28), forehead(0, 40), chin(0, -96), corner(27, -52);
    struct Frames {
        Image flushed, still;
        Pixels seen;
    };
    const auto frames_of = [&](const char* emotion) {
        feel(emotion, 1);
        return Frames{drawn("no", "yes"), drawn("no", "no"), pixels()};
    };
    const auto change = [&](const Frames& frames, glm::vec2 place) {
        return mean_lab(frames.flushed, frames.seen, place, 8) - mean_lab(frames.still, frames.seen, place, 8);
    };
    const Frames anger = frames_of("anger"), fear = frames_of("fear"), joy = frames_of("joy");
    for (const glm::vec2 place : {cheek_left, cheek_right, forehead}) {
        EXPECT_GT(change(anger, place).y, 1.5) << "redder";
        EXPECT_LT(change(fear, place).y, -1) << "paler";
        EXPECT_GT(change(fear, place).x, 0.3) << "lighter";
    }
    const double cheekbone = std::min(change(joy, cheek_left).y, change(joy, cheek_right).y);
    EXPECT_GT(cheekbone, 1);
    EXPECT_GT(cheekbone, 3 * std::abs(change(joy, forehead).y));
    EXPECT_GT(cheekbone, 2 * change(joy, chin).y);
    EXPECT_GT(cheekbone, change(joy, corner).y);
}

TEST_F(EmotionFrames, ASmileFoldsNoForehead) {
    feel("joy", 1);
    const Image folded = drawn("yes", "no"), smooth = drawn("no", "no");
    const Pixels seen = pixels();
    double worst = 0;
    for (std::size_t i = 0; i < seen.skin.size(); ++i) {
        if (seen.skin[i] && seen.canonical_mm[i].y > 25) {
            worst = std::max(worst, ciede2000(lab_of(folded, i), lab_of(smooth, i)));
        }
    }
    EXPECT_LT(worst, 0.5);
}

}  // namespace
}  // namespace blush
