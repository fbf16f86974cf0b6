// Lights, shadows, light through thin parts, the skin's surface and the environment, against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <glm/gtc/matrix_transform.hpp>

#include "rig/light/diffusion_profile.h"
#include "rig/light/skin_reflectance.h"
#include "runtime/frame/frame_state.h"
#include "runtime/light/scene_lights.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

constexpr std::uint32_t side = 48;

/// Adds a quad a, b, c, d (counter-clockwise from its front) with one normal.
void add_quad(Face& face, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    const auto first = static_cast<std::uint32_t>(face.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, d - a));
    for (const glm::vec3 p : {a, b, c, d}) {
        face.positions.push_back(p);
        face.normals.push_back(normal);
        face.tangents.emplace_back(glm::normalize(b - a), 1.0F);
        face.uv0.emplace_back(0.0F);
        face.uv1.emplace_back(0.0F);
    }
    face.indices.insert(face.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

/// A block 60 mm wide and high whose front stands at z = 0 and whose back at -left and -right, metres.
void add_block(Face& face, float left, float right) {
    constexpr float h = 0.03F;
    const glm::vec3 fa(-h, -h, 0), fb(h, -h, 0), fc(h, h, 0), fd(-h, h, 0);
    const glm::vec3 ba(-h, -h, -left), bb(h, -h, -right), bc(h, h, -right), bd(-h, h, -left);
    add_quad(face, fa, fb, fc, fd);
    add_quad(face, bb, ba, bd, bc);
    add_quad(face, ba, fa, fd, bd);
    add_quad(face, fb, bb, bc, fc);
    add_quad(face, fd, fc, bc, bd);
    add_quad(face, ba, bb, fb, fa);
}

/// One primitive of white skin of everything that was added.
Face finished(Face face) {
    face.path = "test";
    Material material;
    material.name = "skin";
    material.metallic = 0;
    face.materials.push_back(material);
    test::add_primitive(face, 0, 0);
    face.meshes.push_back({"mesh", 0, 1});
    Node node;
    node.mesh = 0;
    face.nodes.push_back(node);
    return face;
}

ViewFrame front_view(const Offscreen& offscreen) {
    ViewFrame view = offscreen.view();
    view.samples = 1;
    view.check_finite = true;
    view.camera.view_from_world = glm::lookAt(glm::vec3(0, 0, 0.5F), glm::vec3(0), glm::vec3(0, 1, 0));
    view.camera.clip_from_view = glm::ortho(-0.03F, 0.03F, -0.03F, 0.03F, 0.1F, 1.0F);
    view.background_linear = glm::vec4(0, 0, 0, 1);
    return view;
}

class Lights : public test::GlTest {
protected:
    Portrait plain(Face face) const {
        Portrait character = make_character(std::move(face));
        EXPECT_TRUE(character.set("scattering.method", "off"));
        EXPECT_TRUE(character.set("scattering.millimetres_a_unit", "1000"));
        EXPECT_TRUE(character.set("reflection.intensity", "0"));
        return character;
    }
    static glm::vec3 pixel(const Image& image, std::uint32_t x, std::uint32_t y) {
        const std::size_t at = 4 * (std::size_t{y} * image.width + x);
        return {image.floats[at], image.floats[at + 1], image.floats[at + 2]};
    }
};

Lighting from_direction(glm::vec3 towards, glm::vec3 radiance) {
    Lighting lighting;
    LightSource light;
    light.direction_world = -towards;
    light.radiance_linear = radiance;
    lighting.lights = {light};
    return lighting;
}

/// Half floats hold 0.05 %; the shadow map places its surfaces within some micrometres.
constexpr double transmittance_tolerance = 2e-3;

/// Radiance that white which faces the light reflects at a place: shaders/light/arriving.glsl.
double arriving_radiance(const shared::Light& light, glm::dvec3 place) {
    const glm::dvec3 to = glm::dvec3(light.position_world) - place;
    const double reference2 = static_cast<double>(light.radiance_linear.w);
    const glm::vec3 rgb(light.radiance_linear);
    double radiance = static_cast<double>(std::max({rgb.x, rgb.y, rgb.z}));
    radiance *= reference2 / std::max(glm::dot(to, to), 1e-6 * reference2);
    if (light.cone_world.w <= -1.5F) return radiance;
    const double low = static_cast<double>(light.cone_world.w);
    const double high = std::max(static_cast<double>(light.shadow.y), low + 1e-4);
    const double cosine = glm::dot(-glm::normalize(to), glm::dvec3(light.cone_world));
    const double t = std::clamp((cosine - low) / (high - low), 0.0, 1.0);
    return radiance * t * t * (3 - 2 * t);
}

TEST(LightsThatReach, NoSearchFindsMoreThanTheBoundOfWhatIsLeftOut) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> any(0, 1);
    const auto direction = [&] { return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))); };
    std::size_t left_out = 0;
    std::vector<std::uint32_t> reaching;
    double tightest = 1e9;
    for (int round = 0; round < 20'000; ++round) {
        LightSource light;
        light.kind = any(random) < 0.5 ? LightKind::point : LightKind::spot;
        const double distance = std::pow(10.0, 4 * any(random) - 1), radius = 1;
        light.position_world = distance * direction();
        light.reference_distance = static_cast<float>(std::pow(10.0, 3 * any(random) - 2));
        light.outer_radians = static_cast<float>(std::pow(10.0, 4.5 * any(random) - 4.3));
        light.inner_radians = static_cast<float>(any(random)) * light.outer_radians;
        // Towards the sphere's rim, where a cone may or may not touch it.
        const glm::dvec3 to = glm::normalize(-light.position_world + 2.0 * radius * any(random) * direction());
        light.direction_world = glm::vec3(to);
        light.radiance_linear = glm::vec3(static_cast<float>(std::pow(10.0, 12 * any(random) - 11)));
        const LightsThatReach found = lights_that_reach(std::span(&light, 1), glm::dvec3(0), radius, reaching);
        if (!reaching.empty()) continue;
        ++left_out;
        EXPECT_EQ(found.left_out, 1U);
        EXPECT_LT(found.left_out_radiance, weakest_radiance);
        const shared::Light shown = shader_light(light, glm::dvec3(0));
        // The nearest place, the light itself where it is inside, and a climb from places of the cone.
        const glm::dvec3 at(light.position_world);
        glm::dvec3 best = distance > radius ? glm::normalize(at) * radius : at;
        double most = arriving_radiance(shown, best);
        double step = radius;
        for (int climb = 0; climb < 60; ++climb) {
            glm::dvec3 tried = best + step * direction();
            if (climb < 10) tried = at + to * std::clamp(-glm::dot(at, to) + radius * normal(random), 1e-6, 1e6);
            if (glm::length(tried) > radius) tried = glm::normalize(tried) * radius;
            const double radiance = arriving_radiance(shown, tried);
            if (radiance > most) {
                most = radiance;
                best = tried;
            } else {
                step *= 0.9;
            }
        }
        // Positions and directions go to the shader in single precision.
        ASSERT_LE(most, found.left_out_radiance * (1 + 1e-4) + 1e-12) << "round " << round;
        if (most > 0) tightest = std::min(tightest, found.left_out_radiance / most);
    }
    EXPECT_GT(left_out, 3000U);
    EXPECT_LT(tightest, 1.01) << "the bound is far from what there is";
}

TEST_F(Lights, ASlabAndAWedgeLetThroughWhatTheProfileSays) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    const Lighting behind = from_direction({0, 0, -1}, glm::vec3(1));
    // A wedge with equal ends is a slab.
    for (const auto& [left_mm, right_mm] : {std::pair(2.0, 2.0), std::pair(5.0, 5.0), std::pair(1.5, 9.0)}) {
        Face face;
        add_block(face, static_cast<float>(left_mm / 1000), static_cast<float>(right_mm / 1000));
        for (const bool derived : {true, false}) {
            Portrait character = plain(finished(face));
            ASSERT_TRUE(character.set("translucency.attenuation", derived ? "derived" : "printed"));
            ViewFrame view = front_view(offscreen);
            view.lighting = &behind;
            const Image image = test::draw(character, offscreen, view);
            for (std::uint32_t x = 6; x < side - 6; x += 5) {
                const double thickness = left_mm + (right_mm - left_mm) * (x + 0.5) / side;
                const glm::dvec3 through = derived ? transmittance(skin_six_gaussians(), thickness)
                                                   : transmittance_as_printed(skin_six_gaussians(), thickness);
                for (glm::length_t c = 0; c < 3; ++c) {
                    // Eq. 5.13 has 0.3 + 1 where the light stands right behind.
                    EXPECT_NEAR(static_cast<double>(pixel(image, x, side / 2)[c]), 1.3 * through[c],
                                1.3 * transmittance_tolerance)
                        << thickness << " mm, channel " << c;
                }
            }
        }
    }
}

TEST_F(Lights, ThroughASlabSlantedLightGoesItsWholeWay) {
    // Wider than what is seen, so that no light comes in by its sides.
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    constexpr double slab_mm = 2.5;
    Face face;
    add_block(face, static_cast<float>(slab_mm / 1000), static_cast<float>(slab_mm / 1000));
    for (const float degrees : {0.0F, 30.0F, 44.0F}) {
        for (const double strength : {1.0, 0.5}) {
            for (const double drawn_in_mm : {0.5, 1.0}) {
                const float angle = degrees / 57.29578F;
                const Lighting behind = from_direction({std::sin(angle), 0, -std::cos(angle)}, glm::vec3(1));
                Portrait character = plain(finished(face));
                ASSERT_TRUE(character.set("translucency.strength", std::to_string(strength)));
                ASSERT_TRUE(character.set("translucency.drawn_in_mm", std::to_string(drawn_in_mm)));
                ViewFrame view = front_view(offscreen);
                view.lighting = &behind;
                const glm::vec3 drawn = pixel(test::draw(character, offscreen, view), side / 2, side / 2);
                const double cosine = std::cos(static_cast<double>(angle));
                const glm::dvec3 through = transmittance(skin_six_gaussians(), slab_mm / cosine);
                for (glm::length_t c = 0; c < 3; ++c) {
                    EXPECT_NEAR(static_cast<double>(drawn[c]), strength * (0.3 + cosine) * through[c],
                                1.3 * transmittance_tolerance)
                        << degrees << " degrees, channel " << c;
                }
            }
        }
    }
}

TEST_F(Lights, ThroughTheOpenBackOfAShellComesNone) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    Face face;
    add_quad(face, {-0.03F, -0.03F, 0}, {0.03F, -0.03F, 0}, {0.03F, 0.03F, 0}, {-0.03F, 0.03F, 0});
    const Lighting behind = from_direction({0, 0, -1}, glm::vec3(1));
    Portrait character = plain(finished(face));
    ViewFrame view = front_view(offscreen);
    view.lighting = &behind;
    const Image image = test::draw(character, offscreen, view);
    EXPECT_EQ(pixel(image, side / 2, side / 2), glm::vec3(0));
}

/// Half floats hold 0.05 %, the tables 0.5 % of a highlight.
constexpr double reflection_tolerance = 6e-3;

TEST_F(Lights, TheSurfaceReflectsAndLetsInWhatItsTwinSays) {
    // A white block's front, looked at aslant, by lights from several sides.
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    Face face;
    add_block(face, 0.06F, 0.06F);
    const glm::dvec3 eye(0.3, 0, 0.4);
    for (const double roughness : {0.2, 0.45}) {
        for (const double intensity : {0.4, 1.0}) {
            for (const glm::vec3 towards : {glm::vec3(0, 0, 1), glm::vec3(-0.6F, 0, 0.8F), glm::vec3(-0.5F, 0.1F, 0.5F),
                                            glm::vec3(0.7F, 0.3F, 0.4F), glm::vec3(-0.95F, 0, 0.3F)}) {
                const Lighting lighting = from_direction(towards, glm::vec3(1));
                Portrait character = plain(finished(face));
                ASSERT_TRUE(character.set("shadows.method", "off"));
                ASSERT_TRUE(character.set("reflection.intensity", std::to_string(intensity)));
                ASSERT_TRUE(character.set("reflection.roughness", std::to_string(0.5 * roughness)));
                ViewFrame view = front_view(offscreen);
                view.camera.view_from_world = glm::lookAt(glm::vec3(eye), glm::vec3(0), glm::vec3(0, 1, 0));
                view.lighting = &lighting;
                const Image image = test::draw(character, offscreen, view);
                // The middle of the picture lies between four pixels; what they see there is nearly straight.
                const auto drawn = static_cast<double>(
                    0.25F * (pixel(image, side / 2, side / 2).r + pixel(image, side / 2 - 1, side / 2).r +
                             pixel(image, side / 2, side / 2 - 1).r + pixel(image, side / 2 - 1, side / 2 - 1).r));
                const glm::dvec3 v = glm::normalize(eye), l = glm::normalize(glm::dvec3(towards)), h = l + v;
                const double h2 = glm::dot(h, h), n_h = h.z / std::sqrt(h2), v_h = glm::dot(v, h) / std::sqrt(h2);
                const double surface = 3.14159265358979 * intensity * skin_specular(n_h, v_h, h2, roughness) * l.z;
                const double in = 1 - intensity * skin_specular_albedo(l.z, roughness);
                const double out = (1 - intensity * skin_specular_albedo(v.z, roughness)) /
                                   (1 - intensity * skin_specular_albedo_mean(roughness));
                EXPECT_NEAR(drawn, surface + l.z * in * out, reflection_tolerance * std::max(1.0, surface))
                    << roughness << " " << intensity << " " << l.x << " " << l.y << " " << l.z;
            }
        }
    }
}

TEST_F(Lights, ASlabOfMarbleLetsThroughWhatMarbleDoes) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    const Lighting behind = from_direction({0, 0, -1}, glm::vec3(1));
    Face face;
    add_block(face, 0.004F, 0.004F);
    Portrait character = plain(finished(face));
    ASSERT_TRUE(character.set("scattering.material", "marble"));
    ViewFrame view = front_view(offscreen);
    view.lighting = &behind;
    const glm::vec3 drawn = pixel(test::draw(character, offscreen, view), side / 2, side / 2);
    const glm::dvec3 through = transmittance(gaussians_of(measured_materials()[0]), 4);
    for (glm::length_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(static_cast<double>(drawn[c]), 1.3 * through[c], 1.3 * transmittance_tolerance) << c;
        EXPECT_GT(drawn[c], 2 * transmittance(skin_six_gaussians(),
                                              4)[c]);  // marble is clearer than skin
    }
}

TEST_F(Lights, TheEdgeOfAShadowIsAsWideAsTheLight) {
    // A plate above the front's right half. Seen from below it, the light's disc
    // goes behind the plate's edge little by little: the lit share is that of a
    // disc cut by a line.
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    constexpr float height = 0.02F;
    Face face;
    add_block(face, 0.06F, 0.06F);
    add_quad(face, {0, -0.03F, height}, {0.03F, -0.03F, height}, {0.03F, 0.03F, height}, {0, 0.03F, height});
    for (const float tangent : {0.04F, 0.1F}) {
        Lighting lighting = from_direction({1, 0, 1}, glm::vec3(1));
        lighting.lights[0].size = std::atan(tangent);
        Portrait character = plain(finished(face));
        ASSERT_TRUE(character.set("translucency.strength", "0"));
        ViewFrame view = front_view(offscreen);
        view.lighting = &lighting;
        const Image image = test::draw(character, offscreen, view);
        // Across the beam the disc is tangent * distance wide; the floor sees it
        // stretched by the slant of 45 degrees.
        const double distance = static_cast<double>(height) * std::sqrt(2.0);
        const double half_width_mm = 1000 * static_cast<double>(tangent) * distance * std::sqrt(2.0);
        double before = 1;
        for (std::uint32_t x = 4; x < side / 2 - 1; ++x) {
            const double at_mm = -30 + (x + 0.5) * 60.0 / side, u = std::clamp((at_mm + 20) / half_width_mm, -1.0, 1.0);
            const double lit = 0.5 - (u * std::sqrt(1 - u * u) + std::asin(u)) / 3.14159265358979;
            const double drawn = static_cast<double>(pixel(image, x, side / 2).r) * std::sqrt(2.0);
            // 32 taps of a disc, and blockers found by 16.
            EXPECT_NEAR(drawn, lit, 0.12) << at_mm << " mm";
            EXPECT_LE(drawn, before + 0.02) << "the edge comes and goes at " << at_mm;
            before = drawn;
        }
    }
}

TEST_F(Lights, MapsOfRoughnessAndReflectionAreReadWhereGltfHasThem) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    Lighting lighting = from_direction({0, 0, 1}, glm::vec3(1));
    const auto drawn = [&](Material material, std::vector<std::uint8_t> texel) {
        Face face;
        add_block(face, 0.06F, 0.06F);
        face = finished(face);
        material.name = "skin";
        material.metallic = 0;
        material.base_color_linear = glm::vec4(0, 0, 0, 1);  // the surface alone
        if (!texel.empty()) {
            Image image;
            image.width = image.height = 1;
            image.channels = 4;
            image.bytes = std::move(texel);
            face.images.push_back(image);
        }
        face.materials[0] = material;
        Portrait character = make_character(face);
        EXPECT_TRUE(character.set("scattering.method", "off"));
        ViewFrame view = front_view(offscreen);
        view.lighting = &lighting;
        return pixel(test::draw(character, offscreen, view), side / 2, side / 2).r;
    };
    Material rough, smooth, mapped_rough, mapped_smooth, dull, mapped_dull, full;
    rough.roughness = mapped_rough.roughness = mapped_smooth.roughness = 1;
    smooth.roughness = 0.4F;
    mapped_rough.metallic_roughness.image = mapped_smooth.metallic_roughness.image = 0;
    EXPECT_EQ(drawn(mapped_rough, {0, 255, 0, 255}), drawn(rough, {}));
    EXPECT_NEAR(drawn(mapped_smooth, {255, 102, 255, 255}), drawn(smooth, {}),
                2e-4F);  // green alone: 102 is 0.4
    EXPECT_GT(drawn(smooth, {}), 2 * drawn(rough, {}));
    dull.specular = 0.2F;
    mapped_dull.specular_map.image = 0;
    EXPECT_NEAR(drawn(dull, {}), 0.2F * drawn(full, {}), 2e-4F);
    EXPECT_NEAR(drawn(mapped_dull, {255, 255, 255, 51}), drawn(dull, {}),
                2e-4F);  // alpha alone: 51 is 0.2
}

TEST_F(Lights, ASurfaceInTheLightHasNoFreckles) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    Face face;
    add_block(face, 0.06F, 0.06F);
    for (const glm::vec3 towards : {glm::vec3(0, 0, 1), glm::vec3(0.5F, 0.3F, 0.8F), glm::vec3(0.9F, 0.2F, 0.2F),
                                    glm::vec3(0.1F, -0.97F, 0.05F)}) {
        for (const float size : {0.0F, 0.06F, 0.4F}) {
            Lighting lighting = from_direction(towards, glm::vec3(1));
            lighting.lights[0].size = size;
            Portrait with = plain(finished(face)), without = plain(finished(face));
            ASSERT_TRUE(without.set("shadows.method", "off"));
            ASSERT_TRUE(with.set("translucency.strength", "0"));
            ViewFrame view = front_view(offscreen);
            view.lighting = &lighting;
            const Image shadowed = test::draw(with, offscreen, view), free = test::draw(without, offscreen, view);
            const float n_l = glm::normalize(towards).z;
            EXPECT_LE(std::abs(pixel(free, side / 2, side / 2).r - n_l), 1e-3F);
            for (std::uint32_t y = 2; y < side - 2; ++y) {
                for (std::uint32_t x = 2; x < side - 2; ++x)
                    ASSERT_EQ(pixel(shadowed, x, y), pixel(free, x, y)) << x << " " << y;
            }
        }
    }
}

TEST_F(Lights, AnOutlineIsLitAsItsSurfaceAndNotAsWhatLiesBeyondIt) {
    // A round column, lit from behind, whose outermost sides are turned away from the camera but for a degree and a
    // half: a sample meets them where the pixel's middle lies sides farther on. Sheared, so that all samples meet them
    // somewhere.
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    const Lighting behind = from_direction({0, 0, -1}, glm::vec3(1));
    constexpr int sides = 36;
    constexpr float radius = 0.02F, shear = 0.23F, half_height = 0.025F, turn_radians = 1.5F * 6.2831853F / 360;
    Face face;
    for (int k = 0; k < sides; ++k) {
        const auto at = [&](int corner, float y) {
            const float angle = (static_cast<float>(k + corner) - 0.5F) * 6.2831853F / sides - turn_radians;
            return glm::vec3(std::sin(angle), y, std::cos(angle)) * glm::vec3(radius, 1, radius) +
                   glm::vec3(shear * y, 0, 0);
        };
        add_quad(face, at(0, -half_height), at(1, -half_height), at(1, half_height), at(0, half_height));
        for (std::size_t v = face.normals.size() - 4; v < face.normals.size(); ++v) {
            const glm::vec3 p = face.positions[v] - glm::vec3(shear * face.positions[v].y, 0, 0);
            face.normals[v] = glm::normalize(glm::vec3(p.x, 0, p.z));
        }
    }
    // A side that is seen has normals up to half a side beyond a right angle.
    const float most = std::sin((0.5F * 360 / sides + 1.7F) / 57.29578F);
    for (const std::uint32_t samples : {1U, 2U, 4U}) {
        Portrait character = plain(finished(face));
        ASSERT_TRUE(character.set("shadows.method", "off"));
        ViewFrame view = front_view(offscreen);
        view.lighting = &behind;
        view.samples = samples;
        float brightest = 0;
        const Image image = test::draw(character, offscreen, view);
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x) brightest = std::max(brightest, pixel(image, x, y).r);
        }
        EXPECT_LE(brightest, most) << samples << " samples";
    }
}

TEST_F(Lights, AShadowFallsWhereTheLightIsBlocked) {
    // A plate 10 mm above the front's right half; light from straight in front of a little to the left.
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    Face face;
    add_block(face, 0.06F, 0.06F);
    const float z = 0.01F;
    add_quad(face, {0, -0.03F, z}, {0.03F, -0.03F, z}, {0.03F, 0.03F, z}, {0, 0.03F, z});
    const Lighting lighting = from_direction({1, 0, 1}, glm::vec3(1));
    Portrait character = plain(finished(face));
    ASSERT_TRUE(character.set("translucency.strength", "0"));
    ViewFrame view = front_view(offscreen);
    view.lighting = &lighting;
    const Image image = test::draw(character, offscreen, view);
    // The plate's left edge at x = 0 throws its shadow 10 mm to the left: from -10 mm on it is dark.
    const double pixel_mm = 60.0 / side;
    for (std::uint32_t x = 1; x < side / 2 - 1; ++x) {
        const double at_mm = -30 + (x + 0.5) * pixel_mm;
        if (std::abs(at_mm + 10) < 1.0) continue;  // the filter's width, and the bias
        EXPECT_LE(std::abs(pixel(image, x, side / 2).r - (at_mm < -10 ? std::sqrt(0.5F) : 0.0F)), 2e-3F)
            << at_mm << " mm";
    }
}

TEST_F(Lights, EveryLightHasItsOwnShadow) {
    // The plate as above, lit from the right and from the left.
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    Face face;
    add_block(face, 0.06F, 0.06F);
    const float z = 0.01F;
    add_quad(face, {0, -0.03F, z}, {0.03F, -0.03F, z}, {0.03F, 0.03F, z}, {0, 0.03F, z});
    Lighting lighting = from_direction({1, 0, 1}, {1, 0, 0});
    lighting.lights.push_back(from_direction({-1, 0, 1}, {0, 1, 0}).lights[0]);
    Portrait character = plain(finished(face));
    ASSERT_TRUE(character.set("translucency.strength", "0"));
    ViewFrame view = front_view(offscreen);
    view.lighting = &lighting;
    const Image image = test::draw(character, offscreen, view);
    const double pixel_mm = 60.0 / side;
    for (std::uint32_t x = 1; x < side / 2 - 1; ++x) {
        const double at_mm = -30 + (x + 0.5) * pixel_mm;
        if (std::abs(at_mm + 10) < 1.0) continue;  // the filter's width, and the bias
        EXPECT_LE(std::abs(pixel(image, x, side / 2).r - (at_mm < -10 ? std::sqrt(0.5F) : 0.0F)), 2e-3F) << at_mm;
        EXPECT_LE(std::abs(pixel(image, x, side / 2).g - std::sqrt(0.5F)), 2e-3F) << at_mm;
    }
}

TEST_F(Lights, PointAndSpotLightsFollowTheInverseSquareAndTheirCone) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    Face face;
    add_block(face, 0.06F, 0.06F);
    Lighting lighting;
    LightSource light;
    light.kind = LightKind::point;
    light.position_world = {0, 0, 0.2F};
    light.reference_distance = 0.2F;
    lighting.lights = {light};
    Portrait character = plain(finished(face));
    ASSERT_TRUE(character.set("translucency.strength", "0"));
    ViewFrame view = front_view(offscreen);
    view.lighting = &lighting;
    Image image = test::draw(character, offscreen, view);
    for (const std::uint32_t x : {side / 2, 8U, 40U}) {
        const double offset = (-30 + (x + 0.5) * 60.0 / side) / 1000, up = 0.5 * 0.06 / side;
        const double distance2 = offset * offset + up * up + 0.04;
        const double expected = 0.04 / distance2 * (0.2 / std::sqrt(distance2));
        EXPECT_NEAR(static_cast<double>(pixel(image, x, side / 2).r), expected, 2e-3);
    }
    lighting.lights[0].kind = LightKind::spot;
    lighting.lights[0].direction_world = {0, 0, -1};
    lighting.lights[0].inner_radians = 0.04F;
    lighting.lights[0].outer_radians = 0.08F;  // 16 mm at 200 mm
    image = test::draw(character, offscreen, view);
    EXPECT_LE(std::abs(pixel(image, side / 2, side / 2).r - 1), 3e-3F);
    EXPECT_EQ(pixel(image, 4, side / 2).r, 0.0F);
    // Between them it fades by the cosine.
    const double fades_mm = -30 + (14 + 0.5) * 60.0 / side, cosine = 200 / std::hypot(200.0, fades_mm, 0.625);
    const double share = (cosine - std::cos(0.08)) / (std::cos(0.04) - std::cos(0.08));
    ASSERT_GT(share, 0.2);
    ASSERT_LT(share, 0.8);
    EXPECT_NEAR(static_cast<double>(pixel(image, 14, side / 2).r),
                cosine * cosine * cosine * share * share * (3 - 2 * share), 4e-3);
}

TEST_F(Lights, AWhiteFurnaceStaysWhite) {
    Image white;
    white.width = 64;
    white.height = 32;
    white.channels = 3;
    white.floats.assign(64 * 32 * 3, 1.0F);
    const auto environment = make_environment(white);
    ASSERT_TRUE(environment);
    Lighting lighting;
    lighting.environment = *environment;
    Face face = test::make_face({.targets = 0});
    face.materials[0].base_color_linear = glm::vec4(1);
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    for (const char* scattering : {"off", "separable"}) {
        for (const float roughness : {0.2F, 0.5F, 1.0F}) {
            face.materials[0].roughness = roughness;
            Portrait character = make_character(face);
            ASSERT_TRUE(character.set("scattering.method", scattering));
            ViewFrame view = test::framed_view(character, offscreen);
            view.samples = 1;
            view.lighting = &lighting;
            view.background_linear = glm::vec4(0, 0, 0, 1);
            const Image image = test::draw(character, offscreen, view);
            std::size_t seen = 0;
            for (std::size_t p = 0; p < image.floats.size(); p += 4) {
                if (image.floats[p] == 0) continue;
                ++seen;
                for (std::size_t c = 0; c < 3; ++c)
                    ASSERT_LE(std::abs(image.floats[p + c] - 1), 0.002F) << "pixel " << p / 4;
            }
            EXPECT_GT(seen, 500U);
        }
    }
}

TEST_F(Lights, AnEnvironmentTurnsAndShinesFromItsSide) {
    Image image;
    image.width = 32;
    image.height = 16;
    image.channels = 3;
    image.floats.assign(32 * 16 * 3, 0.0F);
    for (std::size_t y = 5; y < 11; ++y) {
        for (std::size_t x = 14; x < 18; ++x) {  // a window in front, at +Z
            for (std::size_t c = 0; c < 3; ++c) image.floats[3 * (y * 32 + x) + c] = 20;
        }
    }
    const auto environment = make_environment(image);
    ASSERT_TRUE(environment);
    Face face;
    add_block(face, 0.06F, 0.06F);
    Portrait character = plain(finished(face));
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    ViewFrame view = front_view(offscreen);
    Lighting lighting;
    lighting.environment = *environment;
    view.lighting = &lighting;
    const float facing = pixel(test::draw(character, offscreen, view), 24, 24).r;
    lighting.environment_turn_radians = 3.14159265F;
    const float away = pixel(test::draw(character, offscreen, view), 24, 24).r;
    lighting.environment_turn_radians = 0;
    lighting.environment_factor = 0;
    const float dark = pixel(test::draw(character, offscreen, view), 24, 24).r;
    EXPECT_GT(facing, 5 * away + 0.5F);
    EXPECT_EQ(dark, 0.0F);
}

TEST_F(Lights, ASurfaceMirrorsWhatStandsInTheMirrorsDirectionAsSharplyAsItIsSmooth) {
    Image image;
    image.width = 32;
    image.height = 16;
    image.channels = 3;
    image.floats.assign(32 * 16 * 3, 0.0F);
    std::fill_n(image.floats.begin(), 32 * 8 * 3, 1.0F);  // the upper half
    const auto environment = make_environment(image);
    ASSERT_TRUE(environment);
    Lighting lighting;
    lighting.environment = *environment;
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    // Black skin, whose surface alone shines; looked at from below and from above.
    const auto mirrored = [&](float roughness, float eye_height) {
        Face face;
        add_block(face, 0.06F, 0.06F);
        face = finished(std::move(face));
        face.materials[0].base_color_linear = glm::vec4(0, 0, 0, 1);
        face.materials[0].roughness = roughness;
        Portrait character = plain(std::move(face));
        EXPECT_TRUE(character.set("reflection.intensity", "1"));
        ViewFrame view = front_view(offscreen);
        view.camera.view_from_world = glm::lookAt(glm::vec3(0, eye_height, 0.4F), glm::vec3(0), glm::vec3(0, 1, 0));
        view.lighting = &lighting;
        return pixel(test::draw(character, offscreen, view), side / 2, side / 2).r;
    };
    const float sky = mirrored(0.1F, -0.3F), ground = mirrored(0.1F, 0.3F);
    EXPECT_NEAR(static_cast<double>(sky), skin_specular_albedo(0.8, 0.08), 3e-3);
    EXPECT_LT(ground, 0.02F * sky);
    // A wall in front, and then behind.
    for (std::size_t y = 0; y < 16; ++y) {
        for (std::size_t x = 0; x < 32; ++x)
            std::fill_n(&image.floats[3 * (32 * y + x)], 3, x >= 8 && x < 24 ? 1.0F : 0.0F);
    }
    lighting.environment = *make_environment(image);
    const float front = mirrored(0.1F, 0);
    lighting.environment_turn_radians = 3.14159265F;
    EXPECT_GT(front, 50 * mirrored(0.1F, 0));
    lighting.environment_turn_radians = 0;
    lighting.environment = *environment;
    const float rough_sky = mirrored(0.8F, -0.3F), rough_ground = mirrored(0.8F, 0.3F);
    EXPECT_GT(rough_ground, 0.1F * rough_sky);
}

TEST_F(Lights, WithoutLightTheFaceIsBlackAndScatteringIsLeftOut) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    Portrait character = make_character(test::make_face({.targets = 0}));
    const Lighting none;
    ViewFrame view = test::framed_view(character, offscreen);
    view.lighting = &none;
    view.background_linear = glm::vec4(0, 0, 0, 1);
    for (const float value : test::draw(character, offscreen, view).floats) EXPECT_TRUE(value == 0 || value == 1);
    for (const EffectReport& effect : character.draw(view).effects) {
        if (effect.effect == "scattering") {
            EXPECT_EQ(effect.reason, "no light falls on the skin");
        }
        if (effect.effect == "shadows") {
            EXPECT_EQ(effect.reason, "no light shines");
        }
    }
}

TEST_F(Lights, ShadowMapsStandWhileNothingMoves) {
    const Offscreen offscreen = make_offscreen(side, side, Output::linear_hdr);
    Portrait character = make_character(test::make_face({.targets = 1}));
    const Lighting lighting = from_direction({1, 1, 1}, glm::vec3(1));
    ViewFrame view = test::framed_view(character, offscreen);
    view.lighting = &lighting;
    const auto drawn = [&] {
        const FrameReport& report = character.draw(view);
        return std::ranges::any_of(report.passes, [](const PassReport& pass) { return pass.name == "shadow maps"; });
    };
    EXPECT_TRUE(drawn());
    EXPECT_FALSE(drawn());
    test::set_weights(character, {1});
    EXPECT_TRUE(drawn());
    EXPECT_FALSE(drawn());
    const Lighting other = from_direction({-1, 1, 1}, glm::vec3(1));
    view.lighting = &other;
    EXPECT_TRUE(drawn());
    const Image kept = test::draw(character, offscreen, view);
    view.force_effects = true;
    EXPECT_EQ(test::draw(character, offscreen, view).floats, kept.floats);
}

}  // namespace
}  // namespace blush
