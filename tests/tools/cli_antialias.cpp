/// blush antialias and blush bake smaa-tables, as a user runs them.

#include <algorithm>
#include <cmath>
#include <limits>

#include "rig/antialias/smaa_tables.h"
#include "runtime/files/picture_file.h"
#include "tests/tools/cli_run.h"

namespace blush::test {
namespace {

class CliAntialias : public Cli {
protected:
    /// A disk, light on dark, with numbers of every depth; alpha falls from left to right.
    PictureFile disk(std::uint32_t channels, PictureDepth depth, std::uint32_t width = 40,
                     std::uint32_t height = 33) const {
        PictureFile picture;
        picture.depth = depth;
        picture.linear = picture.premultiplied_alpha = depth == PictureDepth::half || depth == PictureDepth::single;
        picture.image.width = width;
        picture.image.height = height;
        picture.image.channels = channels;
        for (std::uint32_t y = 0; y < height; ++y) {
            for (std::uint32_t x = 0; x < width; ++x) {
                const bool inside = std::hypot(static_cast<float>(x) - 19.3F, static_cast<float>(y) - 15.7F) < 12.4F;
                for (std::uint32_t c = 0; c < channels; ++c) {
                    const bool alpha = (channels == 2 || channels == 4) && c == channels - 1;
                    // 16-bit numbers that 8 bits do not hold.
                    const float light = (inside ? 52345.0F : 4321.0F + 11.0F * static_cast<float>(c)) / 65535.0F;
                    const float value = alpha ? 1 - static_cast<float>(x) / 100.0F : light;
                    if (depth == PictureDepth::bits_8) {
                        picture.image.bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * value)));
                    } else {
                        picture.image.floats.push_back(value);
                    }
                }
            }
        }
        return picture;
    }
    void put(const std::string& name, const PictureFile& picture) const {
        const Status written = write_picture(path(name), picture);
        ASSERT_TRUE(written) << written.error().message;
    }
    PictureFile get(const std::string& name) const {
        Result<PictureFile> picture = load_picture(path(name));
        if (!picture) {
            ADD_FAILURE() << picture.error().message;
            return {};
        }
        return *std::move(picture);
    }
    static double number(const Image& image, std::size_t i) {
        return image.bytes.empty() ? static_cast<double>(image.floats[i]) : image.bytes[i] / 255.0;
    }
};

TEST_F(CliAntialias, KeepsDepthChannelsAndFlatParts) {
    struct Kind {
        const char* ending;
        PictureDepth depth;
        std::uint32_t channels;
        const char* on;
    };
    for (const Kind kind :
         {Kind{".png", PictureDepth::bits_8, 1, "cpu"}, Kind{".png", PictureDepth::bits_8, 4, "gpu"},
          Kind{".png", PictureDepth::bits_16, 2, "cpu"}, Kind{".png", PictureDepth::bits_16, 4, "gpu"},
          Kind{".exr", PictureDepth::half, 3, "cpu"}, Kind{".exr", PictureDepth::single, 4, "gpu"}}) {
        const std::uint32_t channels = kind.channels;
        SCOPED_TRACE(kind.ending + std::string(" of ") + std::to_string(channels) + " channels, depth " +
                     std::to_string(static_cast<int>(kind.depth)));
        const std::string in = std::string("in") + kind.ending, out = std::string("out") + kind.ending;
        put(in, disk(channels, kind.depth));
        const PictureFile before = get(in);
        expect_works("antialias " + in + " -o " + out + " --on " + kind.on);
        const PictureFile after = get(out);
        EXPECT_EQ(after.depth, kind.depth);
        ASSERT_EQ(after.image.channels, channels);
        ASSERT_EQ(after.image.width, before.image.width);
        ASSERT_EQ(after.image.height, before.image.height);
        std::size_t changed = 0;
        for (std::size_t i = 0; i < 40U * 33 * channels; ++i) {
            const double difference = std::abs(number(after.image, i) - number(before.image, i));
            changed += difference > 0 ? 1U : 0U;
            EXPECT_LT(difference, 0.55);
        }
        EXPECT_GT(changed, 60U);
        EXPECT_LT(changed, 240U * channels);  // the contour and no more: flat parts keep their bits
    }
}

TEST_F(CliAntialias, CpuAndGpuAgree) {
    put("in.png", disk(3, PictureDepth::bits_8));
    for (const std::string mode : {"--mode mlaa", "--mode smaa1x --preset ultra"}) {
        expect_works("antialias in.png -o gpu.png " + mode + " --edges ge.png --weights gw.png");
        expect_works("antialias in.png -o cpu.png " + mode + " --edges ce.png --weights cw.png --on cpu");
        expect_same("ge.png", "ce.png");
        for (const auto& [one, other] : {std::pair("gpu.png", "cpu.png"), std::pair("gw.png", "cw.png")}) {
            const PictureFile a = get(one), b = get(other);
            ASSERT_EQ(a.image.bytes.size(), b.image.bytes.size());
            int worst = 0;
            for (std::size_t i = 0; i < a.image.bytes.size(); ++i)
                worst = std::max(worst, std::abs(a.image.bytes[i] - b.image.bytes[i]));
            EXPECT_LE(worst, 1) << one;
        }
    }
}

/// On CPU and GPU, by each filter in turn: the same finite picture within a step of 8 bits (relative above 1).
class OddPictures : public CliAntialias {
protected:
    void expect_filtered(const std::string& ending, const PictureFile& picture) const {
        const std::string in = "in" + ending;
        put(in, picture);
        const PictureFile before = get(in);
        const std::string mode = ++tried_ % 2 == 0 ? "mlaa" : "smaa1x";
        expect_works("antialias " + in + " -o cpu" + ending + " --on cpu --mode " + mode);
        expect_works("antialias " + in + " -o gpu" + ending + " --on gpu --mode " + mode);
        const PictureFile cpu = get("cpu" + ending), gpu = get("gpu" + ending);
        ASSERT_EQ(cpu.image.channels, before.image.channels);
        const std::size_t count = before.image.bytes.size() + before.image.floats.size();
        ASSERT_EQ(cpu.image.bytes.size() + cpu.image.floats.size(), count);
        ASSERT_EQ(gpu.image.bytes.size() + gpu.image.floats.size(), count);
        for (std::size_t i = 0; i < count; ++i) {
            const double a = number(cpu.image, i), b = number(gpu.image, i);
            EXPECT_TRUE(std::isfinite(a)) << mode << " at " << i;
            EXPECT_LE(std::abs(a - b), 1.001 / 255 * std::max(1.0, std::abs(a))) << mode << " at " << i;
        }
    }
    /// Every third pixel is what `odd` says.
    PictureFile with(float odd, PictureDepth depth, std::uint32_t channels = 4) const {
        PictureFile picture = disk(channels, depth, 23, 19);
        for (std::size_t i = 0; i < picture.image.floats.size(); i += std::size_t{3} * channels) {
            picture.image.floats[i] = odd;
        }
        return picture;
    }

private:
    mutable int tried_ = 0;
};

TEST_F(OddPictures, OfOnePixelOneRowOneColumnAndOddSides) {
    for (const auto& [width, height] : {std::pair(1U, 1U), {37U, 1U}, {1U, 37U}, {35U, 13U}}) {
        SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
        expect_filtered(".png", disk(3, PictureDepth::bits_8, width, height));
    }
    expect_filtered(".png", disk(1, PictureDepth::bits_8, 35, 13));
    expect_filtered(".exr", disk(1, PictureDepth::half, 1, 9));
}

TEST_F(OddPictures, OfNumbersThatAreNotFiniteNegativeOrBeyondADisplay) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const float odd : {nan, infinity, -infinity, -2.0F, 30'000.0F}) {
        SCOPED_TRACE(odd);
        expect_filtered(".exr", with(odd, PictureDepth::single));
    }
    expect_filtered(".exr", with(infinity, PictureDepth::half, 1));
}

/// What is not finite is read as 0.
TEST_F(OddPictures, OfNothingButNanAreBlack) {
    PictureFile picture = disk(3, PictureDepth::single, 17, 9);
    std::ranges::fill(picture.image.floats, std::numeric_limits<float>::quiet_NaN());
    put("in.exr", picture);
    for (const char* on : {"cpu", "gpu"}) {
        const Ran ran = blush(std::string("antialias in.exr -o out.exr --on ") + on);
        EXPECT_EQ(ran.exit_status, 0);
        EXPECT_EQ(ran.output, "out.exr: 17x9, 0 edges, 0 pixels changed\n");
        EXPECT_EQ(get("out.exr").image.floats, std::vector<float>(std::size_t{17} * 9 * 3, 0.0F));
    }
}

TEST_F(OddPictures, ThatAreHugeAreFilteredOrRefused) {
    expect_filtered(".png", disk(1, PictureDepth::bits_8, 16'384, 2));
    put("wide.png", disk(1, PictureDepth::bits_8, 16'385, 1));
    expect_refused("antialias wide.png -o out.png", "wide.png: the image is 16385x1 pixels; a side may have 16384");
    // A header of 16384 x 16384 pixels before the bytes of a small picture.
    put("small.png", disk(3, PictureDepth::bits_8, 8, 8));
    std::string bytes = bytes_of("small.png");
    ASSERT_EQ(bytes.substr(12, 4), "IHDR");
    bytes.replace(16, 8, std::string("\0\0\x40\0\0\0\x40\0", 8));
    write("lie.png", bytes);
    const Ran lie = blush("antialias lie.png -o out.png");
    EXPECT_EQ(lie.exit_status, 2);
    EXPECT_THAT(lie.errors, testing::StartsWith("blush: lie.png: "));
}

TEST_F(CliAntialias, SettingsByHandChangeTheResult) {
    put("in.png", disk(3, PictureDepth::bits_8));
    put("depth.png", disk(1, PictureDepth::bits_16));
    expect_works("antialias in.png -o high.png --on cpu");
    for (const char* setting : {"--preset low", "--corner-rounding 0", "--blend gamma",
                                "--edges-from depth --depth depth.png --depth-threshold 0.9"}) {
        expect_works(std::string("antialias in.png -o other.png --on cpu ") + setting);
        EXPECT_NE(bytes_of("other.png"), bytes_of("high.png")) << setting;
    }
    expect_works(
        "antialias in.png -o same.png --on cpu --edges-from color --threshold 0.2 --contrast-factor 0.3 "
        "--predication --depth depth.png");
    expect_same("same.png", "high.png");  // one strong contour, whichever way it is found
    expect_works(
        "antialias in.png -o none.png --on cpu --threshold 0.5 --edges-from depth --depth depth.png "
        "--depth-threshold 1");
    EXPECT_EQ(get("none.png").image.bytes, get("in.png").image.bytes);
}

TEST_F(CliAntialias, BadInputIsNamed) {
    put("in.png", disk(3, PictureDepth::bits_8));
    put("in.exr", disk(3, PictureDepth::half));
    put("small.png", disk(3, PictureDepth::bits_8, 8, 8));
    write("text.png", "hello");
    write("cut.png", bytes_of("in.png").substr(0, 200));
    const std::string small = "antialias in.png -o out.png ";
    expect_refused("antialias text.png -o out.png", "text.png: the image is not PNG, JPEG, WebP, HDR or EXR");
    expect_refused("antialias in.png -o out.wat", "out.wat: no picture format is known by the ending \".wat\"");
    expect_refused(small + "--edges no/e.png", "no/e.png: cannot be written: the folder no does not exist");
    expect_refused(small + "--weights w.wat", "w.wat: no picture format is known by the ending \".wat\"");
    expect_refused("antialias in.exr -o out.png",
                   "out.png: in.exr holds linear light, which goes into a .exr or .hdr file");
    expect_refused("antialias in.png -o out.exr",
                   "out.exr: in.png holds display values, which do not go into a .exr file");
    expect_refused(small + "--mode smaa9x", "--mode: smaa9x not in {smaa1x,mlaa}");
    expect_refused(small + "--threshold nan", "--threshold: \"nan\" is not a number from 0 to 0.5");
    expect_refused(small + "--search-steps 33", "--search-steps: Value 33 not in range 1 to 32");
    expect_refused(small + "--edges-from depth", "--edges-from depth needs --depth FILE");
    expect_refused(small + "--depth small.png", "--depth is used with --edges-from depth or --predication alone");
    expect_refused(small + "--edges-from depth --depth small.png",
                   "small.png: the depth is 8x8 pixels and the picture 40x33");
    expect_refused(small + "--mode mlaa --diagonal-steps 3",
                   "--diagonal-steps goes with --mode smaa1x: MLAA has no diagonals");
    expect_refused(small + "--mode mlaa --search-steps 5",
                   "--search-steps 5: MLAA's area table reaches 8 pixels, which is 4 steps");
    const Ran cut = blush("antialias cut.png -o out.png");
    EXPECT_EQ(cut.exit_status, 2);
    EXPECT_THAT(cut.errors, testing::StartsWith("blush: cut.png: "));
}

TEST_F(CliAntialias, BakesTheTables) {
    expect_works("bake smaa-tables -o tables");
    const PictureFile areas = get("tables/smaa_areas.png"), search = get("tables/smaa_search.png");
    EXPECT_EQ(areas.image.width, 160U);
    EXPECT_EQ(areas.image.height, 560U);
    EXPECT_EQ(areas.image.channels, 2U);
    EXPECT_EQ(areas.image.bytes, published_area_image().near_far);
    EXPECT_EQ(search.image.width, 64U);
    EXPECT_EQ(search.image.height, 16U);
    EXPECT_EQ(search.image.channels, 1U);
    EXPECT_EQ(search.image.bytes, search_table());
    expect_refused("bake smaa-tables -o no/tables", "no/tables: this folder cannot be made: No such file or directory");
    expect_refused("bake smaa-tables", "--output is required");
}

}  // namespace
}  // namespace blush::test
