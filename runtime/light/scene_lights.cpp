#include "runtime/light/scene_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace blush {
namespace {

bool finite(glm::dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool usable(const LightSource& light) {
    const glm::vec3 radiance = light.radiance_linear;
    if (!finite(radiance) || !(std::max({radiance.x, radiance.y, radiance.z}) > 0)) return false;
    if (light.kind != LightKind::point) {
        const float length = glm::length(light.direction_world);
        if (!(length > 1e-18F) || !std::isfinite(length)) return false;
    }
    if (light.kind == LightKind::directional) return true;
    const bool cone = std::isfinite(light.inner_radians) && light.outer_radians > 0;
    return finite(light.position_world) && light.reference_distance > 0 && std::isfinite(light.reference_distance) &&
           (light.kind == LightKind::point || cone);
}

/// Where an orbiting light is at a time.
LightSource orbited(LightSource light, const glm::dvec3& centre, double time_seconds) {
    if (light.orbit_seconds == 0 || !std::isfinite(light.orbit_seconds) || !std::isfinite(time_seconds)) return light;
    const double turns = std::fmod(time_seconds / static_cast<double>(light.orbit_seconds), 1.0);
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), turns * 2 * std::numbers::pi, glm::dvec3(0, 1, 0)));
    light.direction_world = glm::vec3(turn * glm::dvec3(light.direction_world));
    light.position_world = centre + turn * (light.position_world - centre);
    return light;
}

LightSource from_camera(const glm::dmat4& world_from_view, glm::vec3 towards_view, glm::vec3 radiance, bool shadow) {
    LightSource light;
    light.direction_world =
        glm::vec3(-glm::normalize(glm::dmat3(world_from_view) * glm::dvec3(glm::normalize(towards_view))));
    light.radiance_linear = radiance;
    light.casts_shadow = shadow;
    light.size = 0.0625F;  // a studio lamp behind an umbrella: half a metre wide at four metres
    return light;
}

/// Half angle of the narrowest cone.
constexpr float narrowest_radians = 1e-3F;

/// The greatest radiance that white can reflect of a light anywhere in a sphere.
double greatest_radiance(const LightSource& light, glm::dvec3 centre, double radius) {
    const glm::vec3 rgb = light.radiance_linear;
    const double brightest = static_cast<double>(std::max({rgb.x, rgb.y, rgb.z}));
    if (light.kind == LightKind::directional) return brightest;
    const glm::dvec3 to = centre - light.position_world;
    const double distance = glm::length(to), nearest = std::max(distance - radius, 0.0);
    if (light.kind == LightKind::spot && distance > radius) {
        // The sphere is seen from the light under this angle; beyond the cone it gets nothing at all.
        const double half = std::asin(radius / distance);
        const glm::dvec3 along = glm::normalize(glm::dvec3(light.direction_world));
        const double off = std::acos(std::clamp(glm::dot(along, to) / distance, -1.0, 1.0));
        if (off - half > static_cast<double>(std::max(light.outer_radians, narrowest_radians))) return 0;
    }
    const double reference = static_cast<double>(light.reference_distance);
    // As near as shaders/light/arriving.glsl takes any place to be.
    return brightest * reference * reference / std::max(nearest * nearest, 1e-6 * reference * reference);
}

}  // namespace

void portrait_lighting(const Camera& camera, Lighting& out) {
    const glm::dmat4 world_from_view = glm::inverse(camera.view_from_world);
    out.lights.clear();
    out.lights.push_back(from_camera(world_from_view, {-0.55F, 0.55F, 0.75F}, {1.75F, 1.62F, 1.48F}, true));
    out.lights.push_back(from_camera(world_from_view, {0.9F, 0.05F, 0.55F}, {0.34F, 0.38F, 0.46F}, false));
    out.lights.push_back(from_camera(world_from_view, {0.55F, 0.65F, -0.85F}, {0.9F, 0.97F, 1.05F}, true));
    out.sky_radiance_linear = {0.20F, 0.215F, 0.24F};
    out.ground_radiance_linear = {0.085F, 0.075F, 0.07F};
}

void usable_lights(const Lighting& lighting, double time_seconds, std::vector<LightSource>& out) {
    out.clear();
    for (const LightSource& light : lighting.lights) {
        if (usable(light)) out.push_back(orbited(light, lighting.orbit_centre_world, time_seconds));
    }
}

LightsThatReach lights_that_reach(std::span<const LightSource> lights, glm::dvec3 centre, double radius,
                                  std::vector<std::uint32_t>& out) {
    LightsThatReach found;
    out.clear();
    for (std::uint32_t l = 0; l < lights.size(); ++l) {
        const double radiance = greatest_radiance(lights[l], centre, radius);
        if (radiance >= weakest_radiance) {
            out.push_back(l);
        } else {
            ++found.left_out;
            found.left_out_radiance += radiance;
        }
    }
    if (out.size() <= BLUSH_MOST_LIGHTS) return found;
    // The strongest, in the order in which the scene has them.
    const auto weaker_end = out.begin() + BLUSH_MOST_LIGHTS;
    std::ranges::nth_element(out, weaker_end, [&](std::uint32_t a, std::uint32_t b) {
        const double x = greatest_radiance(lights[a], centre, radius), y = greatest_radiance(lights[b], centre, radius);
        return x > y || (x == y && a < b);
    });
    for (auto l = weaker_end; l != out.end(); ++l) {
        ++found.left_out;
        found.left_out_radiance += greatest_radiance(lights[*l], centre, radius);
    }
    out.erase(weaker_end, out.end());
    std::ranges::sort(out);
    return found;
}

shared::Light shader_light(const LightSource& source, glm::dvec3 origin_world) {
    shared::Light light{};
    // A light brighter than this would overflow the half floats of the scene colour at once.
    const glm::vec3 radiance = glm::clamp(source.radiance_linear, 0.0F, 6e4F);
    const glm::vec3 along =
        source.kind == LightKind::point ? glm::vec3(0, -1, 0) : glm::normalize(source.direction_world);
    if (source.kind == LightKind::directional) {
        light.position_world = glm::vec4(-along, 0);
    } else {
        light.position_world = glm::vec4(glm::vec3(source.position_world - origin_world), 1);
    }
    light.radiance_linear = glm::vec4(radiance, source.reference_distance * source.reference_distance);
    light.cone_world = glm::vec4(along, -2);
    light.shadow = glm::vec4(-1, 0, 0, 0);
    if (source.kind == LightKind::spot) {
        constexpr float widest_radians = 1.55F;  // below a half circle: beyond it the cone has no rim
        const float outer = std::clamp(source.outer_radians, narrowest_radians, widest_radians);
        light.cone_world.w = std::cos(outer);
        light.shadow.y = std::cos(std::clamp(source.inner_radians, 0.0F, outer));
    }
    return light;
}

std::optional<ShadowPlace> place_shadow_map(const LightSource& source, glm::dvec3 centre, double radius,
                                            double nearer_casters) {
    if (!(radius > 0) || !std::isfinite(radius) || !finite(centre)) return std::nullopt;
    const bool directional = source.kind == LightKind::directional;
    const glm::dvec3 along =
        directional ? glm::normalize(glm::dvec3(source.direction_world)) : centre - source.position_world;
    const double distance = directional ? 2 * radius + nearer_casters : glm::length(along);
    if (!(distance > 1.05 * radius) || !std::isfinite(distance)) return std::nullopt;
    const glm::dvec3 axis = directional ? along : along / distance;
    const glm::dvec3 up = std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dmat4 view = glm::lookAtRH(centre - distance * axis, centre, up);
    // What stands before the near plane still casts, from the near plane.
    const double near_distance = std::max(distance - radius - nearer_casters, directional ? 0.0 : 0.02 * distance),
                 far_distance = distance + radius;
    ShadowPlace place;
    place.near_distance = static_cast<float>(near_distance);
    place.far_distance = static_cast<float>(far_distance);
    place.perspective = !directional;
    const double size = std::isfinite(source.size) ? std::max(static_cast<double>(source.size), 0.0) : 0;
    // A light wider than this is an environment.
    constexpr double widest_radians = 0.5;
    if (directional) {
        place.shadow_from_world = glm::orthoRH_NO(-radius, radius, -radius, radius, near_distance, far_distance) * view;
        place.extent = static_cast<float>(2 * radius);
        place.light_size = static_cast<float>(std::tan(std::min(size, widest_radians)));
    } else {
        const double half_radians = std::asin(radius / distance);
        place.shadow_from_world = glm::perspectiveRH_NO(2 * half_radians, 1.0, near_distance, far_distance) * view;
        place.extent = static_cast<float>(2 * std::tan(half_radians));
        place.light_size = static_cast<float>(std::min(size, 0.5 * distance));
    }
    return place;
}

void write_shadow(const ShadowPlace& place, const ShadowTile& tile, glm::dvec3 origin_world, shared::Light& light) {
    light.shadow_from_world = glm::mat4(place.shadow_from_world * glm::translate(glm::dmat4(1), origin_world));
    light.shadow.x = 1;
    light.shadow.z = place.extent / static_cast<float>(tile.side);
    light.shadow.w = place.perspective ? 1 : 0;
    light.shadow_depth = glm::vec4(place.near_distance, place.far_distance, place.light_size, 0);
    light.shadow_tile = glm::vec4(tile.x, tile.y, tile.side, 0);
}

}  // namespace blush
