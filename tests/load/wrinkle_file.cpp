// Wrinkle maps on disk: there and back, an artist's own, and what is refused.

#include "runtime/files/wrinkle_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/files/output_file.h"
#include "tests/gltf_builder.h"

namespace blush {
namespace {

WrinkleSet small_set(float range) {
    WrinkleSet set;
    set.zones = {"one", "two", "three", "four", "five", "six", "seven", "eight", "nine"};
    set.range = range;
    set.derivatives = DerivativeMap(6, 5);
    for (std::size_t i = 0; i < 30; ++i)
        set.derivatives.values[i] = range * glm::vec2(std::sin(static_cast<float>(i)), std::cos(static_cast<float>(i)));
    set.derivatives.values[0] = {0, 0};
    set.masks.assign(9, ScalarMap(4, 4));
    for (std::size_t z = 0; z < 9; ++z) set.masks[z].values[z] = 1;
    return set;
}

class WrinkleFile : public testing::Test {
protected:
    void expect_refused(const std::string& reason) const {
        const Result<WrinkleSet> read = load_wrinkles(folder());
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().message, folder().string() + ": " + reason);
    }
    void write(const std::string& name, const std::string& text) const {
        ASSERT_TRUE(write_file(folder() / name, text));
    }
    void write_picture(const std::string& name, std::uint32_t side, std::uint32_t channels, float value) const {
        Image image;
        image.width = image.height = side;
        image.channels = channels;
        image.floats.assign(std::size_t{side} * side * channels, value);
        ASSERT_TRUE(write_image(folder() / name, image));
    }
    std::filesystem::path folder() const { return folder_ / ""; }
    test::TemporaryFolder folder_;
};

TEST_F(WrinkleFile, ThereAndBackWithinHalfAStep) {
    for (const float range : {1.0F, 2.5F}) {
        const WrinkleSet set = small_set(range);
        ASSERT_TRUE(write_wrinkles(folder(), set));
        const Result<WrinkleSet> read = load_wrinkles(folder());
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->zones, set.zones);
        EXPECT_EQ(read->range, range);
        EXPECT_EQ(read->derivatives.values[0], glm::vec2(0)) << "flat is flat to the bit";
        for (std::size_t i = 0; i < set.derivatives.values.size(); ++i) {
            EXPECT_NEAR(read->derivatives.values[i].x, set.derivatives.values[i].x, range / 253);
            EXPECT_NEAR(read->derivatives.values[i].y, set.derivatives.values[i].y, range / 253);
        }
        ASSERT_EQ(read->masks.size(), 9U);
        for (std::size_t z = 0; z < 9; ++z) EXPECT_EQ(read->masks[z].values, set.masks[z].values);
    }
}

TEST_F(WrinkleFile, FloatingPointMapsAreReadAsTheyAre) {
    ASSERT_TRUE(write_wrinkles(folder(), small_set(1)));
    std::filesystem::remove(folder() / "wrinkles.png");
    write_picture("wrinkles.exr", 3, 3, 0.25F);
    const Result<WrinkleSet> read = load_wrinkles(folder());
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->derivatives.values[4], glm::vec2(0.25F));
    write_picture("wrinkles.exr", 3, 3, std::numeric_limits<float>::quiet_NaN());
    const Result<WrinkleSet> odd = load_wrinkles(folder());
    ASSERT_TRUE(odd) << odd.error().message;
    for (const glm::vec2& derivative : odd->derivatives.values) EXPECT_EQ(derivative, glm::vec2(0));
}

TEST_F(WrinkleFile, WhatIsWrongIsNamed) {
    EXPECT_FALSE(load_wrinkles(folder()));
    write("wrinkles.json", "{");
    expect_refused("wrinkles.json: not a JSON object");
    write("wrinkles.json", R"({"zones": ["a"], "colour": 3})");
    expect_refused("wrinkles.json: there is no key \"colour\"");
    write("wrinkles.json", R"({"zones": []})");
    expect_refused("wrinkles.json: zones: not an array of 1 to 12 names");
    write("wrinkles.json", R"({"zones": ["a"], "range": 0})");
    expect_refused("wrinkles.json: range: not a number above 0, to 100");
    write("wrinkles.json", R"({"zones": ["a", "b", "c", "d", "e"]})");
    EXPECT_THAT(load_wrinkles(folder()).error().message, testing::HasSubstr("wrinkles.png"));
    write_picture("wrinkles.png", 4, 1, 0.5F);
    expect_refused("wrinkles.png: the image has 1 channel; partial derivatives stand in red and green");
    write_picture("wrinkles.png", 4, 3, 0.5F);
    write_picture("wrinkle_mask_1.png", 4, 3, 0.5F);
    expect_refused("wrinkle_mask_1.png: the image has 3 channels; wrinkles.json names 4 zones for it");
    write_picture("wrinkle_mask_1.png", 4, 4, 0.5F);
    write_picture("wrinkle_mask_2.png", 5, 4, 0.5F);
    expect_refused("wrinkle_mask_2.png: is 5x5 texels and wrinkle_mask_1 4x4; masks are of one size");
    write("wrinkle_mask_2.png", "not a picture");
    EXPECT_THAT(load_wrinkles(folder()).error().message, testing::HasSubstr("wrinkle_mask_2.png: "));
}

TEST_F(WrinkleFile, APartOfTheLayoutIsKeptAndHasNoFoldsAtItsBorder) {
    WrinkleSet set = small_set(1);
    set.part = {{0.25F, 0.5F}, {0.75F, 1}};
    for (ScalarMap& mask : set.masks) std::ranges::fill(mask.values, 1.0F);
    ASSERT_TRUE(write_wrinkles(folder(), set));
    const Result<WrinkleSet> read = load_wrinkles(folder());
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->part, set.part);
    for (const ScalarMap& mask : read->masks) {
        for (std::uint32_t i = 0; i < 16; ++i) {
            const bool border = i % 4 == 0 || i % 4 == 3 || i / 4 == 0 || i / 4 == 3;
            EXPECT_EQ(mask.values[i], border ? 0 : 1);
        }
    }
    const std::string start = R"({"zones": ["one"], )", numbers = "not an array of two numbers from 0 to 1";
    write("wrinkles.json", start + R"("layout_from": 0.5})");
    expect_refused("wrinkles.json: layout_from: " + numbers);
    write("wrinkles.json", start + R"("layout_to": [0.5, 1.5]})");
    expect_refused("wrinkles.json: layout_to: " + numbers);
    write("wrinkles.json", start + R"("layout_to": ["a", "b"]})");
    expect_refused("wrinkles.json: layout_to: " + numbers);
    write("wrinkles.json", start + R"("layout_from": [0.5, 0], "layout_to": [0.5, 1]})");
    expect_refused("wrinkles.json: layout_to: not beyond layout_from");
}

TEST_F(WrinkleFile, ThirteenZonesAreTooMany) {
    WrinkleSet set = small_set(1);
    set.zones.resize(13);
    set.masks.resize(13, ScalarMap(4, 4));
    EXPECT_FALSE(write_wrinkles(folder(), set));
    EXPECT_TRUE(std::filesystem::is_empty(folder()));
}

}  // namespace
}  // namespace blush
