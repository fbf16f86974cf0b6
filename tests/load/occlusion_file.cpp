// Occlusion coefficients on disk: what is written is read, and what is damaged is named.

#include "runtime/files/occlusion_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "tests/test_faces.h"

namespace blush {
namespace {

namespace fs = std::filesystem;

class OcclusionFile : public testing::Test {
protected:
    OcclusionFile() : face_(test::make_face({.side = 6, .targets = 2})) {
        std::string name = (fs::temp_directory_path() / "blush_occlusion_XXXXXX").string();
        folder_ = mkdtemp(name.data());
        face_.path = (folder_ / "head.glb").string();
        set_.face_identity = occlusion_identity(face_);
        set_.poses = {{"", {}}, {"t1", {}}};
        test::Random random(5);
        for (OcclusionPose& pose : set_.poses) {
            for (std::size_t v = 0; v < face_.positions.size(); ++v) {
                LightTransfer transfer{};
                for (float& coefficient : transfer) coefficient = random.between(-1.03F, 1.03F);
                pose.transfers.push_back(transfer);
            }
        }
        path_ = occlusion_path(face_.path);
        EXPECT_TRUE(write_occlusion(path_, set_));
        std::ifstream in(path_, std::ios::binary);
        bytes_.assign(std::istreambuf_iterator<char>(in), {});
    }
    ~OcclusionFile() override { fs::remove_all(folder_); }

    std::string refusal(const std::string& bytes) const {
        std::ofstream(path_, std::ios::binary) << bytes;
        const Result<std::optional<OcclusionSet>> read = find_occlusion(face_);
        return read ? "" : read.error().message;
    }

    fs::path folder_, path_;
    Face face_;
    OcclusionSet set_;
    std::string bytes_;
};

TEST_F(OcclusionFile, WhatIsWrittenIsRead) {
    EXPECT_EQ(path_.filename(), "head.occlusion");
    const Result<std::optional<OcclusionSet>> read = find_occlusion(face_);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_TRUE(read->has_value());
    ASSERT_EQ((*read)->poses.size(), 2U);
    EXPECT_EQ((*read)->poses[1].target, "t1");
    for (std::size_t p = 0; p < 2; ++p) {
        for (std::size_t v = 0; v < face_.positions.size(); ++v) {
            for (std::size_t i = 0; i < 9; ++i)
                EXPECT_NEAR((*read)->poses[p].transfers[v][i], set_.poses[p].transfers[v][i], 3.1e-5F);
        }
    }
    // Written again, the same bytes.
    EXPECT_TRUE(write_occlusion(path_, **read));
    std::ifstream in(path_, std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), bytes_);
    fs::remove(path_);
    const Result<std::optional<OcclusionSet>> none = find_occlusion(face_);
    ASSERT_TRUE(none);
    EXPECT_FALSE(none->has_value());
}

TEST_F(OcclusionFile, EveryTruncationIsNamed) {
    for (std::size_t length = 0; length < bytes_.size(); length += length < 64 ? 1 : 97) {
        EXPECT_EQ(refusal(bytes_.substr(0, length)),
                  path_.string() +
                      (length < 8 ? ": this is not a file of occlusion coefficients" : ": the file ends too early"))
            << length;
    }
    EXPECT_EQ(refusal(bytes_ + "x"), path_.string() + ": bytes follow its last pose");
}

TEST_F(OcclusionFile, DamagedHeadersAreNamed) {
    const auto with = [&](std::size_t at, char value) {
        std::string changed = bytes_;
        changed[at] = value;
        return refusal(changed);
    };
    EXPECT_EQ(with(0, 'X'), path_.string() + ": this is not a file of occlusion coefficients");
    EXPECT_EQ(with(8, 2), path_.string() + ": its version is 2; version 1 is read");
    EXPECT_EQ(with(12, 0), path_.string() + ": it has 0 poses; 1 to 8 are read");
    EXPECT_EQ(with(12, 9), path_.string() + ": it has 9 poses; 1 to 8 are read");
    const std::string other = path_.string() + ": it was made for another surface than that of " + face_.path +
                              "; blush bake occlusion makes it anew";
    EXPECT_EQ(with(16, 1), other);
    EXPECT_EQ(with(24, static_cast<char>(bytes_[24] + 1)), other);
    EXPECT_EQ(with(35, 127), path_.string() + ": the name of a pose is too long");
    EXPECT_EQ(with(32, 1), path_.string() + ": its first pose alone must be rest, without a name");
    const std::size_t name = 32 + 4 + face_.positions.size() * 18 + 4;
    EXPECT_EQ(with(name, 'x'), path_.string() + ": the face has no target \"x1\"");
}

TEST_F(OcclusionFile, AMovedVertexIsAnotherSurface) {
    face_.positions[3].y += 1e-4F;
    EXPECT_NE(refusal(bytes_), "");
}

}  // namespace
}  // namespace blush
