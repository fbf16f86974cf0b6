// Odd lights and cameras: what a sane picture of each is, with all of skin's
// effects on.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/frame/effect.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

class HardLight : public test::GlTest {
protected:
    HardLight() : character_(make_character(test::make_face({.targets = 1}))) {
        EXPECT_TRUE(character_.set("scattering.millimetres_a_unit", "100"));
    }

    /// Radiance of every pixel; fails on one that is not finite, in any pass.
    Image drawn(const Lighting* lighting, const std::function<void(ViewFrame&)>& look = {}, std::uint32_t side = 48) {
        const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
        ViewFrame view = test::framed_view(character_, offscreen);
        view.background_linear = glm::vec4(0, 0, 0, 1);
        view.lighting = lighting;
        if (look) look(view);
        Image image = test::draw(character_, offscreen, view);
        for (const float texel : image.floats) EXPECT_TRUE(std::isfinite(texel) && texel >= 0);
        const Offscreen display = make_offscreen(side, side);
        ViewFrame shown = test::framed_view(character_, display);
        shown.lighting = lighting;
        if (look) look(shown);
        test::draw(character_, display, shown);
        return image;
    }
    static double brightest(const Image& image) {
        float most = 0;
        for (std::size_t i = 0; i < image.floats.size(); ++i)
            most = i % 4 == 3 ? most : std::max(most, image.floats[i]);
        return static_cast<double>(most);
    }
    static std::size_t lit_pixels(const Image& image) {
        std::size_t lit = 0;
        for (std::size_t i = 0; i < image.floats.size(); i += 4) lit += image.floats[i] > 1e-4F ? 1U : 0U;
        return lit;
    }
    static Lighting lamp(float radiance) {
        Lighting lighting;
        LightSource light;
        light.direction_world = {-0.3F, -0.2F, -1};
        light.radiance_linear = glm::vec3(radiance);
        lighting.lights = {light};
        return lighting;
    }
    static Lighting surrounded_by(float radiance) {
        Image image;
        image.width = 16;
        image.height = 8;
        image.channels = 3;
        image.floats.assign(16 * 8 * 3, radiance);
        Lighting lighting;
        lighting.environment = *make_environment(image);
        return lighting;
    }

    Portrait character_;
};

TEST_F(HardLight, NoLightIsBlack) {
    const Lighting none;
    EXPECT_EQ(brightest(drawn(&none)), 0);
}

TEST_F(HardLight, ZeroIntensityIsNoLight) {
    for (const LightKind kind : {LightKind::directional, LightKind::point, LightKind::spot}) {
        Lighting zero = lamp(0);
        zero.lights[0].kind = kind;
        zero.lights[0].position_world = {0, 0, 3};
        EXPECT_EQ(brightest(drawn(&zero)), 0);
    }
    Lighting dim = surrounded_by(1);
    dim.environment_factor = 0;
    EXPECT_EQ(brightest(drawn(&dim)), 0);
}

TEST_F(HardLight, ALightInsideTheHeadLightsWhatFacesIt) {
    Lighting inside = lamp(1);
    for (const LightKind kind : {LightKind::point, LightKind::spot}) {
        // In the dome's middle, in its skin, and on a vertex.
        for (const glm::vec3 place :
             {glm::vec3(0, 0, -0.5F), glm::vec3(0, 0, 0.6F), character_.face().positions[210]}) {
            inside.lights[0].kind = kind;
            inside.lights[0].position_world = place;
            inside.lights[0].reference_distance = 1;
            const Image image = drawn(&inside);
            EXPECT_LE(brightest(image), 60000) << "half floats end there";
        }
    }
    // Behind the skin there is no light in front.
    inside.lights[0].position_world = {0, 0, -0.5F};
    inside.lights[0].kind = LightKind::point;
    EXPECT_LT(brightest(drawn(&inside)), 0.1);
}

TEST_F(HardLight, ACameraInsideTheHeadSeesNoOutside) {
    const Lighting light = lamp(1);
    // One-sided skin shows nothing of its back.
    const Image image = drawn(&light, [](ViewFrame& view) {
        view.camera.view_from_world = glm::lookAt(glm::vec3(0, 0, -0.2F), glm::vec3(0, 0, 1), glm::vec3(0, 1, 0));
    });
    EXPECT_EQ(brightest(image), 0);
    // And in the skin itself.
    drawn(&light, [](ViewFrame& view) {
        view.camera.view_from_world = glm::lookAt(glm::vec3(0, 0, 0.6F), glm::vec3(0.3F, 0, 0.5F), glm::vec3(0, 1, 0));
    });
}

TEST_F(HardLight, AHeadAKilometreAwayIsAPixelOrNone) {
    const Lighting light = lamp(1);
    const Image image = drawn(&light, [](ViewFrame& view) {
        view.camera.view_from_world[3].z = -1e4F;  // of units of 100 mm
        view.camera.clip_from_view = glm::perspective(0.4F, 1.0F, 1.0F, 1e5F);
    });
    EXPECT_LE(lit_pixels(image), 4U);
}

TEST_F(HardLight, AHeadAMillimetreAwayFillsThePicture) {
    const Lighting light = lamp(1);
    glm::vec3 nearest(0, 0, -9);
    for (const glm::vec3& p : character_.face().positions) nearest = p.z > nearest.z ? p : nearest;
    const Image image = drawn(&light, [nearest](ViewFrame& view) {
        view.camera.view_from_world =
            glm::lookAt(nearest + glm::vec3(0, 0, 0.01F), nearest, glm::vec3(0, 1, 0));  // 1 mm
        view.camera.clip_from_view = glm::perspective(0.4F, 1.0F, 1e-3F, 10.0F);
    });
    EXPECT_EQ(lit_pixels(image), 48U * 48U);
    EXPECT_LT(brightest(image), 10);
}

TEST_F(HardLight, FieldsOfViewOf1And170Degrees) {
    const Lighting light = lamp(1);
    const auto seen = [&](float degrees) {
        return lit_pixels(drawn(&light, [degrees](ViewFrame& view) {
            view.camera.view_from_world = glm::lookAt(glm::vec3(0, 0, 2), glm::vec3(0), glm::vec3(0, 1, 0));
            view.camera.clip_from_view = glm::perspective(glm::radians(degrees), 1.0F, 0.01F, 100.0F);
        }));
    };
    EXPECT_EQ(seen(1), 48U * 48U);
    const std::size_t wide = seen(170);
    EXPECT_GT(wide, 0U);
    EXPECT_LT(wide, 48U * 48U / 4);
}

TEST_F(HardLight, AFrameOfOnePixel) {
    const Lighting light = lamp(1);
    const Image image = drawn(&light, {}, 1);
    EXPECT_GT(brightest(image), 0.05);
    EXPECT_LT(brightest(image), 2);
}

TEST_F(HardLight, EnvironmentsThatAreBlackOrHoldNaN) {
    const Lighting black = surrounded_by(0);
    EXPECT_EQ(brightest(drawn(&black)), 0);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity(), -5.0F}) {
        const Lighting lighting = surrounded_by(bad);
        EXPECT_EQ(brightest(drawn(&lighting)), 0);
    }
    // One bad texel takes its own light away and nobody else's.
    Image image;
    image.width = 16;
    image.height = 8;
    image.channels = 3;
    image.floats.assign(16 * 8 * 3, 1.0F);
    image.floats[3 * (4 * 16 + 8)] = std::numeric_limits<float>::quiet_NaN();
    Lighting one;
    one.environment = *make_environment(image);
    const Lighting white = surrounded_by(1);
    EXPECT_NEAR(brightest(drawn(&one)), brightest(drawn(&white)), 0.1 * brightest(drawn(&white)));
}

}  // namespace
}  // namespace blush
