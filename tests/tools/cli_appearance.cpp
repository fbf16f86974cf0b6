/// Maps of wrinkles and blood as users leave them: wrong sizes, missing ones, one channel, 16 bits, HDR, NaN.

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <limits>

#include "tests/tools/cli_run.h"

namespace blush::test {
namespace {

class AppearanceCommands : public Cli {
protected:
    AppearanceCommands() { std::filesystem::create_directory(path("face.appearance")); }

    /// A picture of one colour; `odd` takes the place of its first texel.
    void write_picture(const std::string& name, int side, const std::vector<float>& pixel,
                       OIIO::TypeDesc type = OIIO::TypeDesc::UINT8, const std::vector<float>& odd = {}) const {
        const auto out = OIIO::ImageOutput::create(path(name).string());
        OIIO::ImageSpec spec(side, side, static_cast<int>(pixel.size()), type);
        spec.attribute("oiio:UnassociatedAlpha", 1);
        ASSERT_TRUE(out && out->open(path(name).string(), spec));
        std::vector<float> pixels;
        for (int i = 0; i < side * side; ++i) {
            const std::vector<float>& texel = i == 0 && !odd.empty() ? odd : pixel;
            pixels.insert(pixels.end(), texel.begin(), texel.end());
        }
        ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && out->close());
    }
    void write_good_wrinkles() const {
        write("face.appearance/wrinkles.json", R"({"zones": ["chin", "glabella"], "range": 2})");
        write_picture("face.appearance/wrinkles.png", 8, {0.5F, 0.75F, 0.5F});
        write_picture("face.appearance/wrinkle_mask_1.png", 4, {1, 0.5F, 0, 0});
    }
    const std::string draw_ = "render face.glb --size 16x16 --check-finite -o x.png --set mouthSmileLeft=1";
};

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();

TEST_F(AppearanceCommands, MapsOfEveryKindAreDrawn) {
    write_good_wrinkles();
    // Three sizes, 8 and 16 bits, one channel and four; the residual is HDR and not all of it a number.
    write_picture("face.appearance/hemoglobin.png", 5, {0.4F});
    write_picture("face.appearance/melanin.png", 2, {0.3F, 0.3F, 0.3F}, OIIO::TypeDesc::UINT16);
    write_picture("face.appearance/skin.png", 3, {1, 1, 1, 1});
    write_picture("face.appearance/residual.exr", 4, {1, 2, 0.5F}, OIIO::TypeDesc::HALF, {nan, infinity, -infinity});
    // Scale and offset: where the map is not finite, the blood stays.
    write_picture("face.appearance/blush.exr", 4, {1.5F, 0.01F, 0}, OIIO::TypeDesc::FLOAT, {nan, infinity, 0});
    expect_works(draw_ + " --state blush=1 --emotion surprise=1");
    expect_works(draw_ + " --state blush=1 --setting blood.colour=pigments");
    // 16 bits and plain floats for the wrinkles too, with texels that are no numbers.
    write_picture("face.appearance/wrinkles.png", 7, {0.5F, 0.75F, 0.5F}, OIIO::TypeDesc::UINT16);
    expect_works(draw_ + " --emotion anger=1");
    std::filesystem::remove(path("face.appearance/wrinkles.png"));
    write_picture("face.appearance/wrinkles.exr", 6, {0.2F, -0.3F, 0}, OIIO::TypeDesc::FLOAT, {nan, infinity, 0});
    expect_works(draw_ + " --emotion anger=1");
}

TEST_F(AppearanceCommands, MapsThatCannotBeAreRefused) {
    const std::string here = "face.appearance";
    write_picture("face.appearance/melanin.png", 4, {0.3F});
    expect_refused(draw_, here + "/hemoglobin.png: there is no such file");
    write_picture("face.appearance/hemoglobin.png", 4, {0.4F});
    write_picture("face.appearance/joy.exr", 4, {1, 0, 0}, OIIO::TypeDesc::HALF);
    write_picture("face.appearance/anger.exr", 8, {1, 0, 0}, OIIO::TypeDesc::HALF);
    expect_refused(draw_, here + "/anger.exr: its size is not that of joy.exr");
    write_picture("face.appearance/anger.exr", 4, {1}, OIIO::TypeDesc::HALF);
    expect_refused(draw_, here + "/anger.exr: the image has 1 channel; scale and offset stand in the first two");
    std::filesystem::remove(path("face.appearance/anger.exr"));
    write("face.appearance/skin.png", "no picture");
    expect_refused(draw_, here + "/skin.png: the image is not PNG, JPEG, WebP, HDR or EXR");
    std::filesystem::remove(path("face.appearance/skin.png"));

    write_good_wrinkles();
    expect_works(draw_);
    std::filesystem::remove(path("x.png"));
    write_picture("face.appearance/wrinkles.png", 8, {0.5F});
    expect_refused(draw_, here + ": wrinkles.png: the image has 1 channel; partial derivatives stand in red and green");
    write_good_wrinkles();
    write_picture("face.appearance/wrinkle_mask_1.png", 4, {0.5F});
    expect_refused(draw_, here + ": wrinkle_mask_1.png: the image has 1 channel; wrinkles.json names 2 zones for it");
    std::filesystem::remove(path("face.appearance/wrinkle_mask_1.png"));
    expect_refused(draw_, here + ": wrinkle_mask_1.png: there is no such file");
}

TEST_F(AppearanceCommands, TexturesOfEveryKindAreBaked) {
    const std::string places = R"({"left_eye": [0.6, 0.4], "right_eye": [0.4, 0.4], "mouth": [0.5, 0.6]})";
    write("places.json", places);
    // One colour has no variance anywhere; no texel, one texel or all of them are in the disc.
    write_picture("flat.png", 9, {0.8F, 0.6F, 0.5F}, OIIO::TypeDesc::UINT16);
    for (const char* radius : {"0", "0.03125", "100"})
        expect_works(
            std::string("bake appearance --albedo flat.png --landmarks places.json --change-size 8 --radius ") +
            radius + " -o maps");
    write_picture("light.exr", 6, {0.6F, 0.3F, 0.2F}, OIIO::TypeDesc::HALF, {nan, infinity, -infinity});
    expect_works("bake appearance --albedo light.exr --landmarks places.json --change-size 8 --preview -o light");
    expect_refused("bake appearance --albedo flat.png --radius -1 -o more",
                   "--radius: \"-1\" is not a number from 0 to 100");
    expect_refused("bake appearance --albedo flat.png --from face.glb -o more",
                   "bake appearance: --from face.glb needs a FACE or --landmarks to know where its blood goes");
    expect_refused("bake appearance --albedo flat.png --landmarks places.json --from face.glb -o more",
                   "face.appearance: no maps of an expression's blood are here to take (blush bake appearance face.glb "
                   "-o face.appearance makes them)");
}

}  // namespace
}  // namespace blush::test
