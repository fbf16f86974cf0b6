#pragma once
/// A folder with a small face in it, and the command run there.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/tools/run_program.h"

namespace blush::test {

/// A square of 81 vertices with three targets and 0.2 seconds of animation, named face.glb.
class Cli : public ::testing::Test {
protected:
    Cli() {
        GlbBuilder glb;
        glb.grid(8, 8)
            .target("jawOpen", {3, 4}, {{0, -1, 0.25F}, {0, -0.5F, 0}}, {{0, 0.5F, 0}, {0, 0.25F, 0}})
            .target("mouthSmileLeft", {4, 40}, {{0.25F, 0, 0.5F}, {0, 0, 0.25F}}, {{0.5F, 0, 0}, {0, 0.5F, 0}})
            .target("eyeBlinkLeft", {70, 71}, {{0, 0, 0.5F}, {0, 0, 0.5F}}, {{0.5F, 0, 0}, {-0.5F, 0, 0}})
            .weight_animation({0, 0.2F}, {0, 0, 0, 1, 0.5F, 0.5F});
        glb.write(path("face.glb"));
    }

    std::filesystem::path path(const std::string& name) const { return folder_ / name; }
    std::string bytes_of(const std::string& name) const { return contents(path(name)); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path(name), std::ios::binary) << text;
    }

    /// Runs `blush ARGUMENTS` in the folder.
    Ran blush(const std::string& arguments, const std::string& before = "") const {
        return run(before + "'" BLUSH_PROGRAM "' " + arguments, path(""));
    }

    /// The command fails as it should: exit status 2, this sentence alone on standard error, no file left.
    void expect_refused(const std::string& arguments, const std::string& sentence,
                        const std::string& before = "") const {
        const auto was_there = listing(path(""));
        const Ran ran = blush(arguments, before);
        EXPECT_EQ(ran.exit_status, 2) << arguments;
        EXPECT_EQ(ran.errors, "blush: " + sentence + "\n") << arguments;
        EXPECT_EQ(listing(path("")), was_there) << arguments;
    }
    void expect_works(const std::string& arguments) const {
        const Ran ran = blush(arguments);
        EXPECT_EQ(ran.exit_status, 0) << arguments << ": " << ran.errors;
        EXPECT_EQ(ran.errors.find("blush: "), std::string::npos) << ran.errors;
    }

    /// Two files that exist and hold the same bytes.
    void expect_same(const std::string& one, const std::string& other) const {
        EXPECT_FALSE(bytes_of(one).empty()) << one;
        EXPECT_TRUE(bytes_of(one) == bytes_of(other)) << one << " and " << other << " differ";
    }

private:
    TemporaryFolder folder_;
};

}  // namespace blush::test
