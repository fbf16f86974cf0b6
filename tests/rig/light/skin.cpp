// Laws and oracles of the skin's mathematics: profiles, kernels, T(s), surface reflection, spherical harmonics.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "rig/head/skin_material.h"
#include "rig/light/diffusion_profile.h"
#include "rig/light/scatter_image.h"
#include "rig/light/separable_kernel.h"
#include "rig/light/skin_reflectance.h"
#include "rig/light/spherical_harmonics.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

constexpr double pi = std::numbers::pi;

/// Integral of `f` over the plane, of a function of the distance alone; as far as 40 mm, by the midpoint rule in the
/// logarithm of the distance.
template <class F>
glm::dvec3 over_plane(F f) {
    glm::dvec3 sum(0);
    constexpr int steps = 20000;
    const double low = std::log(1e-5), step = (std::log(40.0) - low) / steps;
    for (int i = 0; i < steps; ++i) {
        const double r = std::exp(low + (i + 0.5) * step);
        sum += f(r) * (2 * pi * r * r * step);
    }
    return sum;
}

void expect_near(glm::dvec3 a, glm::dvec3 b, double tolerance, const char* what) {
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << what << ", channel " << c;
}

TEST(DiffusionProfile, KeepsAllLight) {
    expect_near(over_plane([](double r) { return profile_at(skin_six_gaussians(), r); }), glm::dvec3(1), 1e-6, "six");
    // The printed blue of four Gaussians sums to 1.0 - 0.0002 - ... as the table has it.
    expect_near(over_plane([](double r) { return profile_at(skin_four_gaussians(), r); }), {0.9999, 0.9999, 0.9998},
                2e-4, "four");
}

TEST(DiffusionProfile, TransmittanceIsTheIntegralBehindASlab) {
    for (const double s : {0.0, 0.1, 0.5, 1.0, 3.0, 8.0}) {
        const auto behind = [s](double r) { return profile_at(skin_six_gaussians(), std::hypot(r, s)); };
        expect_near(transmittance(skin_six_gaussians(), s), over_plane(behind), 2e-6, "eq. 5.9");  // eq. 5.9 itself
    }
}

TEST(DiffusionProfile, TransmittanceIsWhiteAtNothingAndFalls) {
    expect_near(transmittance(skin_six_gaussians(), 0), glm::dvec3(1), 1e-12, "T(0)");
    glm::dvec3 before(1);
    for (int i = 1; i <= 200; ++i) {
        const glm::dvec3 t = transmittance(skin_six_gaussians(), 0.05 * i);
        for (glm::length_t c = 0; c < 3; ++c) EXPECT_LT(t[c], before[c]) << "at " << 0.05 * i << " mm";
        before = t;
    }
    // Listing 5.1 at 1 mm, worked out by hand for red: 0.113 e^(-1/0.567) + 0.358 e^(-1/1.99) + 0.078 e^(-1/7.41)
    // and what is left of the narrower ones.
    EXPECT_NEAR(transmittance_as_printed(skin_six_gaussians(), 1).r, 0.3047, 5e-4);
    EXPECT_GT(transmittance(skin_six_gaussians(), 1).r, transmittance_as_printed(skin_six_gaussians(), 1).r);
    expect_near(transmittance(skin_six_gaussians(), std::sqrt(2.0)), transmittance_as_printed(skin_six_gaussians(), 1),
                1e-12, "the two forms differ by a factor of sqrt(2) in thickness");
}

TEST(DiffusionProfile, StepResponseIsTheIntegralOfTheProfile) {
    expect_near(step_response(skin_six_gaussians(), 0), glm::dvec3(0.5), 1e-12, "on the edge");
    expect_near(step_response(skin_six_gaussians(), 30), glm::dvec3(1), 1e-9, "far in the light");
    // By brute force over the half plane, cells of 0.02 mm, for the wide terms (the narrow ones need finer cells).
    const auto wide = skin_six_gaussians().subspan(3);
    const double x = 0.7, cell = 0.02;
    glm::dvec3 sum(0);
    for (double a = -14 + cell / 2; a < x; a += cell) {
        for (double b = -14 + cell / 2; b < 14; b += cell) sum += profile_at(wide, std::hypot(a, b)) * cell * cell;
    }
    expect_near(step_response(wide, x), sum, 1e-3, "half plane");
}

TEST(DiffusionProfile, DipoleOfMarbleIsWideAndPositive) {
    for (const ScatteringMaterial& material : measured_materials()) {
        const glm::dvec3 total = over_plane([&](double r) { return dipole_at(material, r); });
        for (glm::length_t c = 0; c < 3; ++c) {
            EXPECT_GT(total[c], 0.0) << material.name;
            EXPECT_LT(total[c], 1.0) << material.name;  // an albedo
        }
    }
    // Jensen et al. 2001, figure 5, give the diffuse reflectance of marble as 0.83, 0.79, 0.75; 40 mm hold most of it.
    expect_near(over_plane([](double r) { return dipole_at(measured_materials()[0], r); }), {0.83, 0.79, 0.75}, 0.06,
                "marble");
}

TEST(DiffusionProfile, GaussiansOfMeasuredMaterialsSpreadAsTheirDipoles) {
    for (const ScatteringMaterial& material : measured_materials()) {
        const std::vector<GaussianTerm> terms = gaussians_of(material);
        ASSERT_LE(terms.size(), most_gaussian_terms);
        glm::dvec3 sum(0);
        for (std::size_t g = 0; g < terms.size(); ++g) {
            sum += terms[g].weight;
            if (g > 0) {
                EXPECT_GT(terms[g].variance_mm2, terms[g - 1].variance_mm2);
            }
        }
        expect_near(sum, glm::dvec3(1), 1e-12, "sum");
        // Light within a distance, of the dipole by fine steps to half a metre and
        // of the Gaussians in closed form.
        const auto within = [&](double to) {
            glm::dvec3 light(0);
            constexpr int steps = 6000;
            const double low = std::log(1e-5), step = (std::log(to) - low) / steps;
            for (int i = 0; i < steps; ++i) {
                const double r = std::exp(low + (i + 0.5) * step);
                light += dipole_at(material, r) * (2 * pi * r * r * step);
            }
            return light;
        };
        const glm::dvec3 all = within(500);
        for (const double r : {0.1, 0.3, 1.0, 3.0, 10.0, 30.0}) {
            glm::dvec3 gaussians(0);
            for (const GaussianTerm& term : terms)
                gaussians += term.weight * (1 - std::exp(-r * r / (2 * term.variance_mm2)));
            expect_near(gaussians, within(r) / all, 0.03, std::string(material.name).c_str());
        }
    }
}

TEST(SeparableKernel, WeightsSumToOneAndThinOutFromTheCentre) {
    for (const std::uint32_t count : {9U, 17U, 25U, 33U}) {
        const std::vector<KernelTap> taps = separable_kernel(skin_kernel_shape(), count);
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < taps.size(); ++i) {
            sum += taps[i].weight;
            const KernelTap& mirror = taps[taps.size() - 1 - i];
            EXPECT_NEAR(taps[i].offset_mm, -mirror.offset_mm, 1e-12);
            expect_near(taps[i].weight, mirror.weight, 1e-12, "mirrored");
            for (glm::length_t c = 0; c < 3; ++c) EXPECT_GE(taps[i].weight[c], 0);
        }
        expect_near(sum, glm::dvec3(1), 1e-12, "sum");
        for (std::size_t i = count / 2 + 1; i + 1 < count; ++i) {
            EXPECT_GT(taps[i + 1].offset_mm - taps[i].offset_mm, taps[i].offset_mm - taps[i - 1].offset_mm);
        }
    }
}

TEST(SeparableKernel, ThePreintegratedOneIsTheStepResponse) {
    const std::vector<KernelTap> taps = preintegrated_kernel(skin_six_gaussians(), 1, 33);
    glm::dvec3 sum(0), below(0);
    for (const KernelTap& tap : taps) {
        sum += tap.weight;
        if (tap.offset_mm < 0) below += tap.weight;
    }
    expect_near(sum, glm::dvec3(1), 1e-12, "sum");
    expect_near(below + 0.5 * taps[16].weight, glm::dvec3(0.5), 1e-12, "symmetric");
    // Of red light, what goes beyond 1 mm on one side.
    double beyond = 0;
    for (const KernelTap& tap : taps) beyond += tap.offset_mm > 1 ? tap.weight.r : 0;
    EXPECT_NEAR(beyond, 1 - step_response(skin_six_gaussians(), 1).r, 0.03);
}

TEST(SeparableKernel, ParametersDoWhatTheirNamesSay) {
    const KernelShape skin = skin_kernel_shape();
    const auto spread = [](const KernelShape& shape, glm::length_t c) {
        double sum = 0;
        for (const KernelTap& tap : separable_kernel(shape, 33)) sum += tap.weight[c] * tap.offset_mm * tap.offset_mm;
        return sum;
    };
    KernelShape wider = skin, weaker = skin, shorter = skin, none = skin;
    wider.width *= 2;
    weaker.strength *= 0.5;
    shorter.falloff *= 0.5;
    none.strength = glm::dvec3(0);
    for (glm::length_t c = 0; c < 3; ++c) {
        EXPECT_GT(spread(wider, c), 2 * spread(skin, c));
        EXPECT_NEAR(spread(weaker, c), 0.5 * spread(skin, c), 1e-9);
        EXPECT_LT(spread(shorter, c), spread(skin, c));
        EXPECT_EQ(spread(none, c), 0);
    }
    EXPECT_GT(spread(skin, 0), spread(skin, 1));  // red goes farthest
    EXPECT_GT(spread(skin, 1), spread(skin, 2));
}

// --- screen space ----------------------------------------------------------------------------------------------------

SkinImage plane(std::uint32_t width, std::uint32_t height) {
    SkinImage image;
    image.width = width;
    image.height = height;
    image.light.assign(std::size_t{width} * height, glm::dvec4(0.625, 0.375, 0.1875, 1));
    image.depth_mm.assign(image.light.size(), 500);
    return image;
}

TEST(ScatterImage, StrengthIsAFactorOnDistance) {
    SkinImage image = plane(48, 8);
    for (std::size_t p = 0; p < image.light.size(); ++p) {
        if (p % 48 < 24) image.light[p] = {0, 0, 0, 1};
    }
    const std::vector<KernelTap> taps = preintegrated_kernel(skin_six_gaussians(), 1, 17);
    const std::vector<KernelTap> narrow = preintegrated_kernel(skin_six_gaussians(), 0.5, 17);
    const ScatterProjection projection{glm::dvec2(4), 0};
    const auto expected = scatter_separable(image, narrow, projection, 0);
    image.strength.assign(image.light.size(), 0.5);
    const auto half_way = scatter_separable(image, taps, projection, 0);
    image.strength.assign(image.light.size(), 0.0);
    const auto none = scatter_separable(image, taps, projection, 0);
    for (std::size_t p = 0; p < image.light.size(); ++p) {
        expect_near(half_way[p], expected[p], 1e-12, "half");
        expect_near(none[p], glm::dvec3(image.light[p]), 1e-12, "none");
    }
}

TEST(ScatterImage, ConstantLightStaysToTheBit) {
    SkinImage image = plane(40, 24);
    for (std::size_t p = 0; p < image.light.size(); p += 3) image.light[p] = glm::dvec4(0);  // and holes change nothing
    for (std::size_t p = 0; p < image.light.size(); p += 3) image.depth_mm[p] = 0;
    const ScatterProjection projection{glm::dvec2(4 * 500.0), 1};
    const std::vector<KernelTap> taps = separable_kernel(skin_kernel_shape(), 17);
    for (const auto& out :
         {scatter_separable(image, taps, projection, 9), scatter_gaussians(image, skin_six_gaussians(), projection),
          scatter_jittered(image, jittered_kernel(skin_six_gaussians()), projection, 9),
          scatter_exact(image, skin_six_gaussians(), projection, 9, 4)}) {
        for (std::size_t p = 0; p < out.size(); ++p) {
            const glm::dvec3 expected = p % 3 == 0 ? glm::dvec3(0) : glm::dvec3(0.625, 0.375, 0.1875);
            expect_near(out[p], expected, 1e-15, "constant");
        }
    }
}

TEST(ScatterImage, ExactConvolutionOfAStraightShadowIsTheClosedForm) {
    SkinImage image = plane(96, 5);
    for (std::size_t p = 0; p < image.light.size(); ++p) {
        if (p % 96 < 48) image.light[p] = {0, 0, 0, 1};
    }
    for (glm::dvec4& light : image.light) light = light.a > 0 && light.r > 0 ? glm::dvec4(1, 1, 1, 1) : light;
    // 5 pixels a millimetre across; a pixel down is as tall as the reach, so that the edge is endless.
    const ScatterProjection projection{{5, 0.02}, 0};
    const std::vector<glm::dvec3> out = scatter_exact(image, skin_six_gaussians(), projection, 0, 9.4);
    for (std::uint32_t x = 8; x < 88; ++x) {
        // A pixel gathers whole pixels: what it sees of the edge is exact at its centre.
        const double distance_mm = (x + 0.5 - 48) / 5;
        expect_near(out[2 * 96 + x], step_response(skin_six_gaussians(), distance_mm), 2e-3, "step");
    }
}

TEST(ScatterImage, NothingCrossesFromOutsideTheMatteOrAStepOfDepth) {
    SkinImage image = plane(32, 16);
    for (std::size_t p = 0; p < image.light.size(); ++p) {
        if (p % 32 >= 16) {
            image.light[p] = glm::dvec4(1000, 1000, 1000, 1);  // bright skin far behind
            image.depth_mm[p] = 700;
        }
    }
    const ScatterProjection projection{glm::dvec2(5 * 500.0), 1};
    const std::vector<KernelTap> taps = separable_kernel(skin_kernel_shape(), 25);
    const auto followed = scatter_separable(image, taps, projection, 10);
    const auto free = scatter_separable(image, taps, projection, 0);
    // The pixel beside the edge: bilinear taps that mix both depths lie within a pixel of it.
    const std::size_t inside = 8 * 32 + 13;
    EXPECT_NEAR(followed[inside].r, 0.625, 1e-9);
    EXPECT_GT(free[inside].r, 2.0);
}

// --- the surface
// -------------------------------------------------------------------------------------------------------

/// The reference: the BRDF itself integrated over the hemisphere, without importance sampling.
double albedo_by_brute_force(double n_l, double roughness) {
    const glm::dvec3 l(std::sqrt(1 - n_l * n_l), 0, n_l);
    constexpr int steps = 1200;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double theta = (i + 0.5) / steps * pi / 2;
        for (int j = 0; j < steps / 2; ++j) {
            const double phi = (j + 0.5) / (steps / 2) * pi;
            const glm::dvec3 v(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
            const glm::dvec3 h = l + v;
            const double length2 = glm::dot(h, h);
            const glm::dvec3 unit = h / std::sqrt(length2);
            sum += skin_specular(unit.z, glm::dot(unit, v), length2, roughness) * v.z * std::sin(theta);
        }
    }
    return sum * 2 * (pi / 2 / steps) * (pi / (steps / 2));
}

TEST(SkinReflectance, AlbedoIsTheIntegralOfTheBrdf) {
    for (const double roughness : {0.2, 0.3, 0.6}) {
        for (const double n_l : {0.1, 0.5, 0.95}) {
            EXPECT_NEAR(skin_specular_albedo(n_l, roughness), albedo_by_brute_force(n_l, roughness), 2e-4)
                << roughness << " " << n_l;
        }
    }
}

TEST(SkinReflectance, SpecularAndDiffuseNeverExceedOneOverTenThousandPairs) {
    // Light from a direction: what the surface reflects, and what enters and leaves again over all directions. The
    // diffuse part's own integral over views is (1 - mean) / (1 - mean).
    double largest = 0, smallest = 1;
    for (int m = 0; m < 100; ++m) {
        const double roughness = (m + 0.5) / 100;
        for (int a = 0; a < 100; ++a) {
            const double n_l = (a + 0.5) / 100;
            const double surface = skin_specular_albedo(n_l, roughness, 24);
            const double inside = 1 - surface;
            largest = std::max(largest, surface + inside);
            smallest = std::min(smallest, inside);
            EXPECT_GE(surface, 0.0);
            EXPECT_LE(surface, 1.0);
        }
    }
    EXPECT_LE(largest, 1.0 + 1e-12);
    EXPECT_GE(smallest, 0.0);
}

TEST(SkinReflectance, MeanOfTheAlbedoAgreesWithAFineIntegral) {
    for (const double roughness : {0.1, 0.3, 0.8}) {
        double sum = 0;
        for (int i = 0; i < 400; ++i)
            sum += 2 * (i + 0.5) / 400 * skin_specular_albedo((i + 0.5) / 400, roughness, 48) / 400;
        EXPECT_NEAR(skin_specular_albedo_mean(roughness), sum, 5e-4);
    }
}

// --- spherical harmonics -------------------------------------------------------------------------------------------

TEST(SphericalHarmonics, ASphereUnderASingleBandIsItsBasisFunction) {
    for (std::size_t i = 0; i < 9; ++i) {
        Sh9Color light{};
        light[i] = glm::dvec3(1);
        constexpr std::array<double, 9> convolution = {pi,     2 * pi / 3, 2 * pi / 3, 2 * pi / 3, pi / 4,
                                                       pi / 4, pi / 4,     pi / 4,     pi / 4};
        for (const glm::dvec3 n : {glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(1, -2, 0.5))}) {
            // Irradiance by brute force: the basis function over the hemisphere around n.
            double sum = 0;
            constexpr int steps = 200;
            for (int a = 0; a < steps; ++a) {
                for (int b = 0; b < 2 * steps; ++b) {
                    const double theta = (a + 0.5) / steps * pi, phi = (b + 0.5) / steps * pi;
                    const glm::dvec3 w(std::sin(theta) * std::cos(phi), std::cos(theta),
                                       std::sin(theta) * std::sin(phi));
                    sum += sh_basis(w)[i] * std::max(glm::dot(n, w), 0.0) * std::sin(theta);
                }
            }
            sum *= (pi / steps) * (pi / steps);
            EXPECT_NEAR(dot(light, clamped_cosine(n)).r, sum, 1e-3) << "coefficient " << i;
            EXPECT_NEAR(dot(light, clamped_cosine(n)).r, convolution[i] * sh_basis(n)[i], 1e-12);
        }
    }
}

TEST(SphericalHarmonics, RotationTurnsTheFunction) {
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 0.8, glm::normalize(glm::dvec3(1, 2, -0.3))));
    const auto matrix = sh_rotation(turn);
    const Sh9 f = {0.3, -1, 0.4, 0.9, -0.2, 0.7, 1.3, -0.8, 0.1};
    const Sh9 turned = rotate(matrix, f);
    const auto value = [](const Sh9& coefficients, glm::dvec3 w) {
        const Sh9 basis = sh_basis(w);
        double sum = 0;
        for (std::size_t i = 0; i < 9; ++i) sum += coefficients[i] * basis[i];
        return sum;
    };
    for (const glm::dvec3 w : {glm::dvec3(1, 0, 0), glm::normalize(glm::dvec3(-1, 3, 2))}) {
        EXPECT_NEAR(value(turned, w), value(f, glm::transpose(turn) * w), 1e-12);
    }
    // The printed matrix of a quarter turn about X (3.4) has z from y: row 1 takes -1 of coefficient 2.
    const auto quarter = sh_rotation(glm::dmat3(glm::rotate(glm::dmat4(1), pi / 2, glm::dvec3(1, 0, 0))));
    EXPECT_NEAR(quarter[1][2], -1, 1e-12);
    EXPECT_NEAR(quarter[2][1], 1, 1e-12);
    EXPECT_NEAR(quarter[4][7], -1, 1e-12);
    EXPECT_NEAR(quarter[6][6], -0.5, 1e-12);
    EXPECT_NEAR(std::abs(quarter[6][8]), std::sqrt(3.0) / 2, 1e-12);
}

TEST(SphericalHarmonics, AUniformEnvironmentLightsWhiteWithItsOwnRadiance) {
    std::vector<float> pixels(std::size_t{32} * 16 * 3, 0.5F);
    const Sh9Color light = project_environment(pixels, 32, 16, 3);
    for (const glm::dvec3 n : {glm::dvec3(0, 1, 0), glm::dvec3(0.6, 0, -0.8)}) {
        expect_near(dot(light, clamped_cosine(n)) / pi, glm::dvec3(0.5), 2e-3, "uniform");
    }
    pixels[7] = std::numeric_limits<float>::quiet_NaN();
    pixels[8] = -3;
    for (const glm::dvec3& c : project_environment(pixels, 32, 16, 3)) {
        for (glm::length_t k = 0; k < 3; ++k) EXPECT_TRUE(std::isfinite(c[k]));
    }
    // The middle of the map is +Z.
    const glm::dvec3 front = environment_direction(0.5, 0.5);
    EXPECT_NEAR(front.z, 1, 1e-12);
    EXPECT_NEAR(environment_direction(0.75, 0.5).x, 1, 1e-12);
    EXPECT_NEAR(environment_direction(0.1, 0).y, 1, 1e-12);
}

// --- which parts are skin --------------------------------------------------------------------------------------------

TEST(SkinMaterial, NamesTell) {
    Face face = test::make_face({.targets = 0});
    const auto one = [&](const char* name) {
        face.materials.assign(2, Material{});
        face.materials[0].name = name;
        face.materials[1].name = "skin";
        return static_cast<bool>(skin_materials(face)[0]);
    };
    for (const char* name : {"Skin", "M_Face", "head_front", "Body", "eyelid", "neck.001"})
        EXPECT_TRUE(one(name)) << name;
    for (const char* name : {"eye_L", "Teeth", "eyelashes", "hair_head", "gums", "iris", "tongue", "head_teeth",
                             "eye_occlusion", "Material.002"}) {
        EXPECT_FALSE(one(name)) << name;
    }
}

TEST(SkinMaterial, WithoutANameThatTellsTheLargestPartIsSkin) {
    Face face = test::make_face({.targets = 0, .two_primitives = true});
    face.materials.assign(2, Material{});
    face.materials[0].name = "Material.001";
    face.materials[1].name = "teeth";
    face.primitives[1].material = 1;
    EXPECT_EQ(skin_materials(face), (std::vector<bool>{true, false, false}));
    face.materials[0].skin = false;
    EXPECT_EQ(skin_materials(face), (std::vector<bool>{false, false, false}));
    face.materials[1].skin = true;
    EXPECT_EQ(skin_materials(face), (std::vector<bool>{false, true, false}));
    face.materials[1].alpha_mode = AlphaMode::blend;
    EXPECT_EQ(skin_materials(face), (std::vector<bool>{false, false, false}));
    face.materials.clear();
    face.primitives[0].material = face.primitives[1].material = -1;
    EXPECT_EQ(skin_materials(face), (std::vector<bool>{true}));
}

TEST(SkinMaterial, MetresAreMetresAndAllElseIsAHead) {
    const auto scale = [](float extent) {
        Bounds bounds;
        bounds.add(glm::vec3(0));
        bounds.add(glm::vec3(extent));
        return millimetres_a_unit(bounds);
    };
    EXPECT_EQ(scale(0.24F), 1000);
    EXPECT_NEAR(scale(24), 10, 1e-5);
    EXPECT_NEAR(scale(2.4F), 100, 1e-4);
    for (const float odd : {0.0F, 1e-30F, 1e30F}) EXPECT_TRUE(std::isfinite(scale(odd)) && scale(odd) > 0);
    EXPECT_TRUE(std::isfinite(millimetres_a_unit(Bounds{})));
}

}  // namespace
}  // namespace blush
