/// A white sphere in a room, against the integral over every texel.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rig/light/skin_reflectance.h"
#include "runtime/measure/sphere_study.h"
#include "runtime/measure/studies.h"

namespace blush {
namespace {

/// A room with a bright window, a lamp and a floor: more than nine coefficients
/// hold.
const Image& study_room() {
    static const Image room = [] {
        Image image;
        image.width = 64;
        image.height = 32;
        image.channels = 3;
        for (std::uint32_t y = 0; y < image.height; ++y) {
            for (std::uint32_t x = 0; x < image.width; ++x) {
                const bool window = x >= 38 && x < 46 && y >= 8 && y < 17, lamp = x >= 12 && x < 15 && y >= 5 && y < 8;
                const glm::vec3 wall = y > 20 ? glm::vec3(0.25F, 0.2F, 0.15F) : glm::vec3(0.4F, 0.42F, 0.45F);
                const glm::vec3 light = window ? glm::vec3(6, 6.5F, 7.5F) : lamp ? glm::vec3(9, 7, 4) : wall;
                image.floats.insert(image.floats.end(), {light.r, light.g, light.b});
            }
        }
        return image;
    }();
    return room;
}

/// White skin in the room: the integral over every texel, without coefficients
/// or filtered maps.
glm::dvec3 exactly_lit(glm::dvec3 n, double intensity) {
    const Image& room = study_room();
    const glm::dvec3 v(0, 0, 1);
    constexpr double pi = std::numbers::pi, m = sphere_roughness;
    static const double mean = skin_specular_albedo_mean(m);
    static const std::vector<float> albedo = [] {  // by cosine: a thousand steps are as good as exact
        std::vector<float> made;
        for (int i = 0; i < 1000; ++i)
            made.push_back(static_cast<float>(skin_specular_albedo((i + 0.5) / 1000, m, 32)));
        return made;
    }();
    const auto mirrored_share = [](double cosine) {
        return static_cast<double>(albedo[static_cast<std::size_t>(std::clamp(cosine * 1000, 0.0, 999.0))]);
    };
    glm::dvec3 inside(0), surface(0);
    for (std::uint32_t y = 0; y < room.height; ++y) {
        const double solid_angle =
            2 * pi / room.width * (std::cos(pi * y / room.height) - std::cos(pi * (y + 1) / room.height));
        for (std::uint32_t x = 0; x < room.width; ++x) {
            const glm::dvec3 l = environment_direction((x + 0.5) / room.width, (y + 0.5) / room.height);
            const double n_l = glm::dot(n, l);
            if (n_l <= 0) continue;
            const std::size_t at = 3 * (std::size_t{y} * room.width + x);
            const glm::dvec3 light(room.floats[at], room.floats[at + 1], room.floats[at + 2]);
            inside += light * (n_l * solid_angle / pi * (1 - intensity * mirrored_share(n_l)));
            const glm::dvec3 h = l + v, unit = glm::normalize(h);
            surface +=
                light * (n_l * solid_angle * skin_specular(glm::dot(n, unit), glm::dot(v, unit), glm::dot(h, h), m));
        }
    }
    return intensity * surface + inside * ((1 - intensity * mirrored_share(n.z)) / (1 - intensity * mean));
}

}  // namespace

std::vector<Study> studies::environment(const Device& device, const Face&, double, bool) {
    Lighting lighting;
    const auto environment = make_environment(study_room());
    if (!environment) return {};
    lighting.environment = *environment;
    return sphere_study(device, "a white sphere in a room with a window and a lamp",
                        "the integral over every texel in double precision", lighting,
                        {{"reflection.intensity", "1", true, [](glm::dvec3 n) { return exactly_lit(n, 1); }},
                         {"reflection.intensity", "0", false, [](glm::dvec3 n) { return exactly_lit(n, 0); }}});
}

}  // namespace blush
