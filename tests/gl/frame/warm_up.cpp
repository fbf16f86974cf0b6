// Scene::warm_up(): after it no frame compiles.

#include <epoxy/gl.h>

#include <filesystem>
#include <iostream>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/frame/device_state.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

class WarmUp : public test::GlTest {
protected:
    struct Shown {
        FaceAsset asset;
        std::vector<Character> characters;
        Scene scene;
        View view;
    };
    Shown shown(const FaceAsset& asset, std::size_t count) const {
        Shown result{asset, {}, *Scene::create(device_), *View::create(device_)};
        for (std::size_t c = 0; c < count; ++c) {
            result.characters.push_back(*Character::create(device_, asset));
            EXPECT_TRUE(result.scene.add(result.characters.back()));
        }
        return result;
    }
    /// Until it is done, by slices of `most`; the programs that it compiled.
    std::uint32_t warm(Shown& shown, const ViewFrame& like, std::uint32_t most) const {
        float share = 0;
        for (int slice = 0; slice < 1000; ++slice) {
            const std::uint64_t before = device_.state().programs.compiled();
            const WarmUpProgress progress = shown.scene.warm_up(shown.view, like, most);
            EXPECT_LE(device_.state().programs.compiled() - before, most + (slice == 0 ? 5 : 0))
                << "of slice " << slice;
            EXPECT_FALSE(progress.failure) << *progress.failure;
            EXPECT_GE(progress.share, share);
            share = progress.share;
            if (progress.done) {
                EXPECT_EQ(share, 1);
                return progress.programs_compiled;
            }
        }
        ADD_FAILURE() << "it never ends";
        return 0;
    }
    /// Programs that frames of any pose, place and camera compile.
    static std::uint32_t compiled_by_frames(Shown& shown, ViewFrame frame, int frames) {
        std::mt19937 random(5);
        std::uniform_real_distribution<float> any(0, 1);
        std::uint32_t compiled = 0;
        const OrbitCamera framing = shown.asset.framing(1);
        for (int f = 0; f < frames; ++f) {
            for (Character& character : shown.characters) {
                for (float& control : character.controls()) control = any(random) < 0.5F ? 0 : any(random);
                const double spread = std::pow(10.0, 2 * static_cast<double>(any(random)) - 1);
                character.place(glm::translate(glm::dmat4(1), spread * glm::dvec3(any(random), any(random), 0)));
            }
            OrbitCamera orbit = framing;
            orbit.yaw_radians = 6 * any(random);
            orbit.distance *= std::pow(10.0F, 4 * any(random) - 1);
            orbit.scene_radius *= 100;
            frame.camera = orbit.camera(1);
            frame.time_seconds += 0.04;
            const FrameReport& report = shown.scene.draw(shown.view, frame);
            compiled += report.programs_compiled;
            EXPECT_FALSE(report.failure);
        }
        return compiled;
    }
};

TEST_F(WarmUp, NoLaterFrameCompiles) {
    const FaceAsset asset = *FaceAsset::load(std::filesystem::path(BLUSH_BINARY_DIR) / "assets/face.glb");
    for (const auto& [mode, count] : {std::pair("view", 1U), {"smaa_t2x", 2U}}) {
        device_ = make_device();
        Shown scene = shown(asset, count);
        ASSERT_TRUE(scene.view.set("antialiasing.mode", mode));
        ASSERT_TRUE(scene.scene.set("shadows.size", "512"));
        const Offscreen offscreen = make_offscreen(16, 16);
        const std::uint32_t compiled = warm(scene, offscreen.view(), 3);
        std::cout << mode << ", " << count << " characters: " << compiled << " programs ahead\n";
        EXPECT_GT(compiled, 10U);
        EXPECT_EQ(compiled_by_frames(scene, offscreen.view(), 40), 0U) << mode << ", " << count;
    }
}

TEST_F(WarmUp, LeavesControlsAndPicturesAsTheyAre) {
    const FaceAsset asset = *FaceAsset::create(test::make_face({.targets = 4, .normal_deltas = true}));
    Shown scene = shown(asset, 1);
    scene.characters[0].controls()[1] = 0.7F;
    const Offscreen offscreen = make_offscreen(48, 48);
    ViewFrame frame = offscreen.view();
    frame.camera = asset.framing(1).camera(1);
    scene.scene.draw(scene.view, frame);
    const std::vector<std::uint8_t> before = offscreen.read().bytes;
    warm(scene, frame, 1);
    EXPECT_EQ(scene.characters[0].controls()[1], 0.7F);
    EXPECT_EQ(offscreen.read().bytes, before) << "it drew into the host's framebuffer";
    scene.scene.draw(scene.view, frame);
    EXPECT_EQ(offscreen.read().bytes, before);
}

}  // namespace
}  // namespace blush
