// Assets load on any thread, several at once.

#include <filesystem>
#include <optional>

#include "runtime/frame/asset_state.h"
#include "tests/four_threads.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

using AssetThreads = test::GlTest;

TEST_F(AssetThreads, LoadAtOnceAndAreTheSame) {
    const std::filesystem::path path = std::filesystem::path(BLUSH_BINARY_DIR) / "assets/face.glb";
    const FaceAsset first = *FaceAsset::load(path);
    const auto loaded = test::on_four_threads([&](std::size_t) -> std::optional<FaceAsset> {
        Result<FaceAsset> asset = FaceAsset::load(path);
        return asset ? std::optional(*std::move(asset)) : std::nullopt;
    });
    const Offscreen offscreen = make_offscreen(24, 24);
    Portrait alone = *Portrait::create(device_, first);
    const Image expected = test::draw(alone, offscreen);
    for (const std::optional<FaceAsset>& asset : loaded) {
        ASSERT_TRUE(asset);
        EXPECT_EQ(asset->face().positions, first.face().positions);
        ASSERT_TRUE(asset->appearance().wrinkles);
        EXPECT_EQ(asset->state().occlusion.has_value(), first.state().occlusion.has_value());
        Portrait shown = *Portrait::create(device_, *asset);
        EXPECT_EQ(test::draw(shown, offscreen).bytes, expected.bytes);
    }
}

}  // namespace
}  // namespace blush
