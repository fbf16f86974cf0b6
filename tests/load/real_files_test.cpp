#include <gtest/gtest.h>

#include "runtime/face_file.h"
#include "tests/shared_data.h"

namespace blush {
namespace {

TEST(RealFiles, FacecapPlainHasItsHeadTargetsAndAnimation) {
    BLUSH_SHARED_OR_SKIP(path, "faces/facecap/facecap_plain.glb");
    const Result<Face> face = load_face(path);
    ASSERT_TRUE(face) << face.error().message;
    EXPECT_EQ(face->positions.size(), 4368U);
    EXPECT_EQ(face->targets.size(), 52U);
    EXPECT_EQ(face->targets[0].name, "browInnerUp");
    EXPECT_FLOAT_EQ(face->targets[0].default_weight, 0.12167F);
    EXPECT_EQ(face->meshes.size(), 4U);
    ASSERT_EQ(face->images.size(), 1U);
    EXPECT_GT(face->images[0].width, 0U);
    ASSERT_EQ(face->animations.size(), 4U);
    ASSERT_EQ(face->animations[0].weights.size(), 1U);
    EXPECT_EQ(face->animations[0].weights[0].track.times_seconds.size(), 335U);
    EXPECT_NEAR(face->animations[0].duration_seconds, 11.18F, 0.05F);
    EXPECT_TRUE(face->notes.empty());
}

}  // namespace
}  // namespace blush
