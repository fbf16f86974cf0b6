/// Skin's reflection on a white sphere, against the reflectance without tables; and in whole frames.

#include <cmath>
#include <numbers>

#include "rig/light/skin_reflectance.h"
#include "runtime/measure/frame_study.h"
#include "runtime/measure/sphere_study.h"
#include "runtime/measure/studies.h"

namespace blush {
namespace {

const Lighting& one_lamp() {
    static const Lighting lighting = [] {
        Lighting made;
        LightSource lamp;
        lamp.direction_world = {-0.5F, -0.4F, -0.8F};
        made.lights = {lamp};
        return made;
    }();
    return lighting;
}

/// White skin under one_lamp(), without a table: what the surface mirrors, and
/// what it lets in and out again (chappuis-2011, 2.3 and 2.6).
glm::dvec3 exactly_reflected(glm::dvec3 n, double intensity) {
    const glm::dvec3 l = -glm::normalize(glm::dvec3(one_lamp().lights[0].direction_world)), v(0, 0, 1);
    const double n_l = glm::dot(n, l), n_v = n.z, m = sphere_roughness;
    if (n_l <= 0) return glm::dvec3(0);
    const glm::dvec3 h = l + v, unit = glm::normalize(h);
    const double mirrored =
        std::numbers::pi * skin_specular(glm::dot(n, unit), glm::dot(v, unit), glm::dot(h, h), m) * n_l;
    static const double mean = skin_specular_albedo_mean(sphere_roughness);
    const double in = 1 - intensity * skin_specular_albedo(n_l, m, 64);
    const double out = (1 - intensity * skin_specular_albedo(n_v, m, 64)) / (1 - intensity * mean);
    return glm::dvec3(intensity * mirrored + in * n_l * out);
}

}  // namespace

std::vector<Study> studies::reflection(const Device& device, const Face& face, double millimetres_a_unit,
                                       bool /*quick*/) {
    std::vector<Study> result =
        sphere_study(device, "a white sphere under one lamp",
                     "the reflectance computed in double precision without "
                     "tables (rig/light/skin_reflectance.h)",
                     one_lamp(),
                     {{"reflection.model", "kelemen", true, [](glm::dvec3 n) { return exactly_reflected(n, 1); }},
                      {"reflection.intensity", "0", false, [](glm::dvec3 n) { return exactly_reflected(n, 0); }},
                      {"reflection.model", "ggx", false, [](glm::dvec3 n) { return exactly_reflected(n, 1); }}});
    for (Study& study : frame_study(device, face, millimetres_a_unit,
                                    {"reflection.model", {"kelemen", "ggx"}, 0, "kelemen", nullptr})) {
        result.push_back(std::move(study));
    }
    return result;
}

}  // namespace blush
