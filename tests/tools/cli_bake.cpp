/// blush bake appearance, as a user meets it.

#include <OpenImageIO/imageio.h>

#include "tests/shared_data.h"
#include "tests/tools/cli_run.h"

namespace blush::test {
namespace {

class Bake : public Cli {
protected:
    void write_picture(const std::string& name, int side, int channels, const std::vector<float>& pixel) const {
        const auto out = OIIO::ImageOutput::create(path(name).string());
        ASSERT_TRUE(out &&
                    out->open(path(name).string(), OIIO::ImageSpec(side, side, channels, OIIO::TypeDesc::UINT8)));
        std::vector<float> pixels;
        for (int i = 0; i < side * side; ++i) pixels.insert(pixels.end(), pixel.begin(), pixel.end());
        ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && out->close());
    }
};

TEST_F(Bake, AppearanceOfATexture) {
    write_picture("skin.png", 8, 3, {0.8F, 0.6F, 0.5F});
    expect_works("bake appearance --albedo skin.png -o maps");
    EXPECT_EQ(listing(path("maps")),
              (std::set<std::string>{"hemoglobin.png", "melanin.png", "residual.exr", "skin.png"}));
    write("places.json", R"({"left_eye": [0.6, 0.4], "right_eye": [0.4, 0.4], "mouth": [0.5, 0.6]})");
    expect_works("bake appearance --albedo skin.png --landmarks places.json -o more --preview");
    EXPECT_EQ(listing(path("more")).size(), 4U + 11 + 12);
    expect_works("bake appearance --albedo skin.png -o again");
    for (const char* name : {"hemoglobin.png", "melanin.png", "residual.exr", "skin.png"}) {
        expect_same(std::string("maps/") + name, std::string("again/") + name);
    }
}

TEST_F(Bake, OneTexelAndOddMasksAreTaken) {
    write_picture("dot.png", 1, 3, {0.8F, 0.6F, 0.5F});
    write_picture("mask.png", 3, 1, {1});
    expect_works("bake appearance --albedo dot.png --mask mask.png -o maps");
}

TEST_F(Bake, BadInputIsNamed) {
    write_picture("grey.png", 4, 1, {0.5F});
    write_picture("skin.png", 4, 3, {0.8F, 0.6F, 0.5F});
    write("line.json", R"({"left_eye": [0, 0], "right_eye": [1, 1], "mouth": [0.5, 0.5]})");
    write("bad.json", R"({"left_eye": [0, 0], "right_eye": [1, 1]})");
    expect_refused("bake", "A subcommand is required");
    expect_refused("bake appearance -o maps", "bake appearance: name a FACE, an --albedo, or both");
    expect_refused("bake appearance --albedo none.png -o maps", "none.png: there is no such file");
    expect_refused("bake appearance --albedo grey.png -o maps",
                   "grey.png: the image has 1 channel; skin is read from a colour texture");
    expect_refused(
        "bake appearance face.glb -o maps",
        "face.glb: eyes and mouth cannot be found, for no targets like eyeBlinkLeft and mouthSmileLeft move its "
        "skin; name their places in the texture with --landmarks");
    expect_refused("bake appearance --albedo skin.png --landmarks line.json -o maps",
                   "line.json: eyes and mouth lie on one line");
    expect_refused("bake appearance --albedo skin.png --landmarks bad.json -o maps", "bad.json: \"mouth\" is missing");
    expect_refused("bake appearance --albedo skin.png --mask none.png -o maps", "none.png: there is no such file");
    expect_refused("bake appearance --albedo skin.png --lightness nan -o maps",
                   "--lightness: \"nan\" is not a number from 0 to 1");
    expect_refused("bake appearance --albedo skin.png -o no/maps",
                   "no/maps: this folder cannot be made: No such file or directory");
}

}  // namespace
}  // namespace blush::test
