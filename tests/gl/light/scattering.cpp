// Scattering on the GPU: its CPU twin, its laws, and what it must not touch.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include <glm/gtc/packing.hpp>

#include "rig/light/scatter_image.h"
#include "runtime/frame/frame_state.h"
#include "runtime/light/scatter_passes.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

constexpr std::uint32_t width = 48, height = 40;

double half(double value) {
    return static_cast<double>(glm::unpackHalf1x16(glm::packHalf1x16(static_cast<float>(value))));
}

/// A skin image with an oval matte, a slope, a step of depth and stripes of light, as half floats hold it.
SkinImage striped() {
    SkinImage image;
    image.width = width;
    image.height = height;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const double dx = (x - 23.5) / 22, dy = (y - 19.5) / 18;
            const double inside = dx * dx + dy * dy;
            const double matte = inside < 0.8 ? 1 : inside < 1 ? 0.5 : 0;
            const double stripe = (x / 7 + y / 9) % 2 == 0 ? 1.4 : 0.15;
            const double depth = 480 + 0.4 * x + (y > 28 ? 30 : 0);
            image.light.emplace_back(half(matte * stripe), half(matte * 0.7 * stripe), half(matte * 0.5 * stripe),
                                     matte);
            image.depth_mm.push_back(static_cast<double>(static_cast<float>(matte * depth)));
            image.strength.push_back(x > 30 ? 0.5 * matte : matte);
        }
    }
    return image;
}

class Scattering : public test::GlTest {
protected:
    gl::Texture texture(GLenum format) const {
        gl::Texture made = gl::make_texture(GL_TEXTURE_2D);
        glTextureStorage2D(made.name(), 1, format, width, height);
        glTextureParameteri(made.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTextureParameteri(made.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(made.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        return made;
    }

    /// What `run` adds to a scene of 0 under a white albedo (times the matte): rgb of every pixel.
    std::vector<glm::vec3> scattered(
        const SkinImage& image, const ScatterProjection& projection, double follow_mm,
        const std::function<void(ScatterPasses&, const ScatterInput&, const ScatterScratch&, GLuint)>& run) {
        std::vector<glm::vec4> light, albedo;
        std::vector<float> depth;
        for (std::size_t p = 0; p < image.light.size(); ++p) {
            light.emplace_back(image.light[p]);
            albedo.emplace_back(glm::vec3(static_cast<float>(image.light[p].a)),
                                static_cast<float>(image.strength.empty() ? image.light[p].a : image.strength[p]));
            depth.push_back(static_cast<float>(image.depth_mm[p]));
        }
        const gl::Texture light_texture = texture(GL_RGBA16F), albedo_texture = texture(GL_RGBA16F),
                          depth_texture = texture(GL_R32F), scene = texture(GL_RGBA32F), first = texture(GL_RGBA16F),
                          second = texture(GL_RGBA16F), third = texture(GL_RGBA16F),
                          stencil = texture(GL_STENCIL_INDEX8);
        const auto upload = [](const gl::Texture& to, GLenum format, const void* data) {
            glTextureSubImage2D(to.name(), 0, 0, 0, width, height, format, GL_FLOAT, data);
        };
        upload(light_texture, GL_RGBA, light.data());
        upload(albedo_texture, GL_RGBA, albedo.data());
        upload(depth_texture, GL_RED, depth.data());
        ScatterInput input;
        input.light = light_texture.name();
        input.albedo = albedo_texture.name();
        input.depth = depth_texture.name();
        input.width = width;
        input.height = height;
        input.projection = projection;
        input.follow_mm = follow_mm;
        ScatterPasses passes;
        run(passes, input, {first.name(), second.name(), third.name(), stencil.name()}, scene.name());
        std::vector<glm::vec4> out(image.light.size());
        glGetTextureImage(scene.name(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(out.size() * sizeof(out[0])),
                          out.data());
        return {out.begin(), out.end()};
    }

    static void expect_twin(const SkinImage& image, const std::vector<glm::vec3>& gpu,
                            const std::vector<glm::dvec3>& cpu, double tolerance) {
        double worst = 0;
        for (std::size_t p = 0; p < gpu.size(); ++p) {
            for (glm::length_t c = 0; c < 3; ++c) {
                worst = std::max(worst, std::abs(static_cast<double>(gpu[p][c]) - cpu[p][c] * image.light[p].a));
            }
        }
        EXPECT_LE(worst, tolerance);
    }
};

// Two half floats are rounded on the way (the light between the passes, at most 1.4: half an ulp is 0.0005), and a
// sampler's weights have at least 8 bits (1/512 of a step of 1.25).
constexpr double half_float_tolerance = 4e-3;
const ScatterProjection close_up{glm::dvec2(5 * 480.0), 1};

TEST_F(Scattering, SeparablePassesAreTheirTwin) {
    const SkinImage image = striped();
    for (const std::uint32_t samples : {9U, 17U, 25U, 33U}) {
        for (const double follow_mm : {0.0, 10.0}) {
            const std::vector<KernelTap> taps = separable_kernel(skin_kernel_shape(), samples);
            const auto gpu =
                scattered(image, close_up, follow_mm,
                          [&](ScatterPasses& passes, const ScatterInput& input, const ScatterScratch& scratch,
                              GLuint scene) { passes.separable(input, taps, scratch, scene); });
            expect_twin(image, gpu, scatter_separable(image, taps, close_up, follow_mm), half_float_tolerance);
        }
    }
}

TEST_F(Scattering, GaussianPassesAreTheirTwin) {
    const SkinImage image = striped();
    for (const auto profile : {skin_four_gaussians(), skin_six_gaussians()}) {
        // The far camera leaves narrow Gaussians out.
        for (const ScatterProjection& projection : {close_up, ScatterProjection{glm::dvec2(1 * 480.0), 1}}) {
            const auto gpu =
                scattered(image, projection, 0,
                          [&](ScatterPasses& passes, const ScatterInput& input, const ScatterScratch& scratch,
                              GLuint scene) { passes.gaussians(input, profile, scratch, scene); });
            // Ten passes round instead of two.
            expect_twin(image, gpu, scatter_gaussians(image, profile, projection), 3 * half_float_tolerance);
        }
    }
}

TEST_F(Scattering, JitteredPassIsItsTwin) {
    const SkinImage image = striped();
    const JitteredKernel kernel = jittered_kernel(skin_six_gaussians());
    const auto gpu = scattered(image, close_up, 10,
                               [&](ScatterPasses& passes, const ScatterInput& input, const ScatterScratch&,
                                   GLuint scene) { passes.jittered(input, kernel, scene); });
    expect_twin(image, gpu, scatter_jittered(image, kernel, close_up, 10), half_float_tolerance);
}

TEST_F(Scattering, ConstantLightStaysToTheLastBit) {
    SkinImage image = striped();
    for (glm::dvec4& light : image.light)
        light = glm::dvec4(half(0.7123), half(0.4321), half(0.2222), 1) * (light.a > 0 ? 1.0 : 0.0);
    for (std::size_t p = 0; p < image.light.size(); ++p) image.depth_mm[p] = image.light[p].a > 0 ? 480 : 0;
    const auto expect_constant = [&](const std::vector<glm::vec3>& out) {
        for (std::size_t p = 0; p < out.size(); ++p) {
            ASSERT_EQ(out[p], glm::vec3(image.light[p])) << "pixel " << p;
        }
    };
    for (const std::uint32_t samples : {9U, 17U, 25U, 33U}) {
        const std::vector<KernelTap> taps = separable_kernel(skin_kernel_shape(), samples);
        expect_constant(scattered(image, close_up, 10,
                                  [&](ScatterPasses& passes, const ScatterInput& input, const ScatterScratch& scratch,
                                      GLuint scene) { passes.separable(input, taps, scratch, scene); }));
    }
    for (const auto profile : {skin_four_gaussians(), skin_six_gaussians()}) {
        const auto out = scattered(image, close_up, 0,
                                   [&](ScatterPasses& passes, const ScatterInput& input, const ScatterScratch& scratch,
                                       GLuint scene) { passes.gaussians(input, profile, scratch, scene); });
        for (std::size_t p = 0; p < out.size(); ++p) {
            for (glm::length_t c = 0; c < 3; ++c) {
                // Blending adds w x and (1 - w) x, which may miss x by one bit of the half float it is stored in.
                ASSERT_LE(std::abs(out[p][c] - static_cast<float>(image.light[p][c])), 0.5F / 1024) << "pixel " << p;
            }
        }
    }
    expect_constant(
        scattered(image, close_up, 10,
                  [&](ScatterPasses& passes, const ScatterInput& input, const ScatterScratch&, GLuint scene) {
                      passes.jittered(input, jittered_kernel(skin_six_gaussians()), scene);
                  }));
}

// --- in whole frames
// ---------------------------------------------------------------------------------------------------

/// A face of skin with a strip of something else across its middle.
Face half_skin() {
    Face face = test::make_face({.targets = 0, .two_primitives = true});
    face.materials.push_back(face.materials[0]);
    face.materials[1].name = "teeth";
    face.primitives[1].material = 1;
    for (glm::vec3& position : face.positions) position *= 0.05F;  // a tenth of a metre: half a head
    return face;
}

ViewFrame close_view(const Portrait& character, const Offscreen& offscreen, std::uint32_t samples) {
    ViewFrame view = test::framed_view(character, offscreen);
    OrbitCamera camera = character.framing(1);
    camera.distance *= 0.5F;
    view.camera = camera.camera(1);
    view.samples = samples;
    return view;
}

TEST_F(Scattering, NoOtherPixelChangesByABit) {
    Portrait with = make_character(half_skin()), without = make_character(half_skin());
    ASSERT_TRUE(with.set("scattering.millimetres_a_unit", "1000"));
    ASSERT_TRUE(without.set("scattering.millimetres_a_unit", "1000"));
    ASSERT_TRUE(without.set("scattering.method", "off"));
    const Offscreen offscreen = make_offscreen(64, 64, Output::linear_hdr);
    for (const std::uint32_t samples : {1U, 4U}) {
        const ViewFrame view = close_view(with, offscreen, samples);
        const Image on = test::draw(with, offscreen, view), off = test::draw(without, offscreen, view);
        std::size_t differing_skin = 0, same = 0;
        for (std::uint32_t y = 0; y < 64; ++y) {
            for (std::uint32_t x = 0; x < 64; ++x) {
                const std::size_t at = 4 * (std::size_t{y} * 64 + x);
                const bool equal = std::equal(&on.floats[at], &on.floats[at] + 4, &off.floats[at]);
                // add_grid puts the first primitive, the skin, at -x.
                if (x > 33) {
                    ASSERT_TRUE(equal) << "pixel " << x << ", " << y << " at " << samples << " samples";
                    ++same;
                } else {
                    differing_skin += equal ? 0U : 1U;
                }
            }
        }
        EXPECT_GT(differing_skin, 500U);
        EXPECT_GT(same, 1000U);
    }
}

TEST_F(Scattering, NoLightOfABrightBackgroundReachesTheSkin) {
    Face face = test::make_face({.targets = 0});
    for (glm::vec3& position : face.positions) position *= 0.1F;
    const Offscreen offscreen = make_offscreen(64, 64, Output::linear_hdr);
    for (const std::uint32_t samples : {1U, 2U, 4U}) {
        Portrait character = make_character(face);
        ViewFrame view = test::framed_view(character, offscreen);
        view.samples = samples;
        view.background_linear = glm::vec4(0, 0, 0, 1);
        const Image dark = test::draw(character, offscreen, view);
        constexpr float bright = 1000;
        view.background_linear = glm::vec4(bright, bright, bright, 1);
        const Image lit = test::draw(character, offscreen, view);
        std::size_t checked = 0;
        for (std::size_t p = 0; p < dark.floats.size(); p += 4) {
            const float before = dark.floats[p];
            const float gained = lit.floats[p] - before;
            // A pixel that the background shares has its share of it; what is beyond any share must not be there.
            if (before == 0 || gained > 1.0F / 5 * bright) continue;  // an outline pixel of at least one sample in four
            EXPECT_LE(std::abs(gained), 0.001F * bright) << "pixel " << p / 4 << " at " << samples << " samples";
            ++checked;
        }
        EXPECT_GT(checked, 500U);
    }
}

TEST_F(Scattering, LeftOutFarAwayItChangesThePictureWithinItsBound) {
    Portrait character = make_character(test::make_face({.targets = 0, .normal_map = true}));
    const Offscreen offscreen = make_offscreen(48, 48, Output::linear_hdr);
    ViewFrame view = test::framed_view(character, offscreen);
    OrbitCamera camera = character.framing(1);
    camera.distance *= 3.8F;  // eight millimetres of reach within half a pixel
    view.camera = camera.camera(1);
    const Image without = test::draw(character, offscreen, view);
    const auto& effects = character.report().effects;
    const auto report = *std::ranges::find(effects, "scattering", &EffectReport::effect);
    ASSERT_FALSE(report.on);
    EXPECT_EQ(report.reason, "the kernel ends within half a pixel of its centre");
    ASSERT_EQ(report.omission, Omission::bounded);
    view.force_effects = true;
    const Image with = test::draw(character, offscreen, view);
    float worst = 0, brightest = 0;
    for (std::size_t i = 0; i < with.floats.size(); ++i) {
        if (i % 4 == 3) continue;
        worst = std::max(worst, std::abs(with.floats[i] - without.floats[i]));
        brightest = std::max(brightest, without.floats[i]);
    }
    EXPECT_GT(worst, 0.0F);
    EXPECT_LE(static_cast<double>(worst / brightest), report.bound);
}

TEST_F(Scattering, OnlyPixelsOfSkinAreWorkedOn) {
    const SkinImage image = striped();
    std::size_t skin = 0;
    for (const glm::dvec4& light : image.light) skin += light.a > 0 ? 1U : 0U;
    const std::vector<KernelTap> taps = preintegrated_kernel(skin_six_gaussians(), 1, 17);
    GLuint written = 0;
    scattered(image, close_up, 10,
              [&](ScatterPasses& passes, const ScatterInput& input, const ScatterScratch& scratch, GLuint scene) {
                  GLuint query = 0;
                  glGenQueries(1, &query);
                  glBeginQuery(GL_SAMPLES_PASSED, query);
                  passes.separable(input, taps, scratch, scene);
                  glEndQuery(GL_SAMPLES_PASSED);
                  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &written);
                  glDeleteQueries(1, &query);
              });
    EXPECT_EQ(written, 2 * skin);
    EXPECT_LT(skin, image.light.size());
}

TEST_F(Scattering, PaintIsSharpWhereLightMeetsItOnItsWayOutAndSoftWhereOnItsWayIn) {
    // A step of the base colour under light from all around: what scatters before it is constant.
    Face face = test::make_face({.targets = 0});
    for (glm::vec3& normal : face.normals) normal = {0, 1, 0};
    Image image;
    image.width = 8;
    image.height = 1;
    image.channels = 4;
    for (int x = 0; x < 8; ++x) {
        for (const std::uint8_t value : {std::uint8_t{255}, std::uint8_t{255}, std::uint8_t{255}, std::uint8_t{255}})
            image.bytes.push_back(x < 4 || image.bytes.size() % 4 == 3 ? value : std::uint8_t{60});
    }
    face.images.push_back(image);
    face.materials[0].base_color_srgb.image = 0;
    Lighting lighting;
    lighting.sky_radiance_linear = glm::vec3(1);
    lighting.ground_radiance_linear = glm::vec3(1);
    const Offscreen offscreen = make_offscreen(64, 64, Output::linear_hdr);
    const auto drawn = [&](const char* method, const char* before) {
        Portrait character = make_character(face);
        EXPECT_TRUE(character.set("scattering.method", method));
        EXPECT_TRUE(character.set("scattering.albedo_before", before));
        EXPECT_TRUE(character.set("scattering.millimetres_a_unit", "20"));
        EXPECT_TRUE(character.set("reflection.intensity", "0"));
        ViewFrame view = test::framed_view(character, offscreen);
        view.samples = 1;
        view.lighting = &lighting;
        return test::draw(character, offscreen, view);
    };
    const Image off = drawn("off", "0"), after = drawn("separable", "0"), before = drawn("separable", "1"),
                half_way = drawn("separable", "0.5");
    double worst_after = 0, worst_before = 0, worst_half_way = 0;
    for (std::size_t i = 0; i < off.floats.size(); ++i) {
        const auto apart = [&](const Image& a) { return static_cast<double>(std::abs(a.floats[i] - off.floats[i])); };
        worst_after = std::max(worst_after, apart(after));
        worst_before = std::max(worst_before, apart(before));
        worst_half_way = std::max(worst_half_way, apart(half_way));
    }
    EXPECT_LE(worst_after, 2e-3);  // half floats of the light, the albedo and the sum
    EXPECT_GT(worst_before, 0.03);
    EXPECT_GT(worst_half_way, 0.3 * worst_before);
    EXPECT_LT(worst_half_way, 0.9 * worst_before);
}

/// A dome of skin under a hard light, its base colour's opacity as given.
class StrengthMap : public test::GlTest {
protected:
    Image drawn(std::uint8_t alpha, bool by_alpha, const char* method) const {
        Face face = test::make_face({.targets = 0});
        Image image;
        image.width = image.height = 1;
        image.channels = 4;
        image.bytes = {255, 255, 255, alpha};
        face.images.push_back(image);
        face.materials[0].base_color_srgb.image = 0;
        face.materials[0].scatter_by_alpha = by_alpha;
        Portrait character = make_character(face);
        EXPECT_TRUE(character.set("scattering.method", method));
        EXPECT_TRUE(character.set("scattering.millimetres_a_unit", "20"));  // some pixels a millimetre
        const Offscreen offscreen = make_offscreen(64, 64, Output::linear_hdr);
        ViewFrame view = test::framed_view(character, offscreen);
        view.samples = 1;
        Lighting lighting;
        LightSource light;
        light.direction_world = {-1, -0.1F, -0.2F};
        lighting.lights = {light};
        view.lighting = &lighting;
        return test::draw(character, offscreen, view);
    }
    static double difference(const Image& a, const Image& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.floats.size(); ++i)
            sum += std::abs(static_cast<double>(a.floats[i]) - static_cast<double>(b.floats[i]));
        return sum;
    }
};

TEST_F(StrengthMap, SaysHowFarLightScatters) {
    for (const char* method : {"separable", "gaussians6", "jittered"}) {
        const Image off = drawn(255, true, "off"), full = drawn(255, true, method), none = drawn(0, true, method),
                    half_way = drawn(128, true, method), ignored = drawn(0, false, method);
        EXPECT_EQ(full.floats, ignored.floats) << method;  // without the material's word, opacity means nothing
        const double all = difference(full, off);
        EXPECT_GT(all, 1.0) << method;
        // With nothing scattered only the half floats between the passes differ.
        EXPECT_LT(difference(none, off), 0.2 * all) << method;
        EXPECT_GT(difference(half_way, off), 0.2 * all) << method;
        EXPECT_LT(difference(half_way, off), 0.9 * all) << method;
    }
}

}  // namespace
}  // namespace blush
