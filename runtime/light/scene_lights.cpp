#include "runtime/light/scene_lights.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace blush {
namespace {

bool finite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

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
LightSource orbited(LightSource light, const glm::vec3& centre, double time_seconds) {
    if (light.orbit_seconds == 0 || !std::isfinite(light.orbit_seconds) || !std::isfinite(time_seconds)) return light;
    const double turns = std::fmod(time_seconds / static_cast<double>(light.orbit_seconds), 1.0);
    const glm::mat3 turn(glm::rotate(glm::mat4(1), static_cast<float>(turns * 6.283185307179586), glm::vec3(0, 1, 0)));
    light.direction_world = turn * light.direction_world;
    light.position_world = centre + turn * (light.position_world - centre);
    return light;
}

LightSource from_camera(const glm::mat4& world_from_view, glm::vec3 towards_view, glm::vec3 radiance, bool shadow) {
    LightSource light;
    light.direction_world = -glm::normalize(glm::mat3(world_from_view) * glm::normalize(towards_view));
    light.radiance_linear = radiance;
    light.casts_shadow = shadow;
    light.size = 0.0625F;  // a studio lamp behind an umbrella: half a metre wide
                           // at four metres
    return light;
}

}  // namespace

Lighting portrait_lighting(const Camera& camera) {
    const glm::mat4 world_from_view = glm::inverse(camera.view_from_world);
    Lighting lighting;
    lighting.lights = {from_camera(world_from_view, {-0.55F, 0.55F, 0.75F}, {1.75F, 1.62F, 1.48F}, true),
                       from_camera(world_from_view, {0.9F, 0.05F, 0.55F}, {0.34F, 0.38F, 0.46F}, false),
                       from_camera(world_from_view, {0.55F, 0.65F, -0.85F}, {0.9F, 0.97F, 1.05F}, true)};
    lighting.sky_radiance_linear = {0.20F, 0.215F, 0.24F};
    lighting.ground_radiance_linear = {0.085F, 0.075F, 0.07F};
    return lighting;
}

void usable_lights(const Lighting& lighting, double time_seconds, std::vector<LightSource>& out) {
    out.clear();
    for (const LightSource& light : lighting.lights) {
        if (out.size() < BLUSH_MOST_LIGHTS && usable(light)) {
            out.push_back(orbited(light, lighting.orbit_centre_world, time_seconds));
        }
    }
}

shared::Light shader_light(const LightSource& source) {
    shared::Light light{};
    // A light brighter than this would overflow the half floats of the scene colour at once.
    const glm::vec3 radiance = glm::clamp(source.radiance_linear, 0.0F, 6e4F);
    const glm::vec3 along =
        source.kind == LightKind::point ? glm::vec3(0, -1, 0) : glm::normalize(source.direction_world);
    if (source.kind == LightKind::directional) {
        light.position_world = glm::vec4(-along, 0);
    } else {
        light.position_world = glm::vec4(source.position_world, 1);
    }
    light.radiance_linear = glm::vec4(radiance, source.reference_distance * source.reference_distance);
    light.cone_world = glm::vec4(along, -2);
    light.shadow = glm::vec4(-1, 0, 0, 0);
    if (source.kind == LightKind::spot) {
        constexpr float widest_radians = 1.55F;  // below a half circle: beyond it the cone has no rim
        const float outer = std::clamp(source.outer_radians, 1e-3F, widest_radians);
        light.cone_world.w = std::cos(outer);
        light.shadow.y = std::cos(std::clamp(source.inner_radians, 0.0F, outer));
    }
    return light;
}

bool place_shadow_map(const LightSource& source, const Bounds& bounds, std::uint32_t side_texels, std::uint32_t index,
                      shared::Light& light) {
    if (bounds.empty()) return false;
    const glm::vec3 centre = bounds.centre();
    // A little more than the bounds, so that a deformation that leaves them somewhat still casts its shadow.
    const float radius = 0.55F * glm::length(bounds.size());
    if (!(radius > 0) || !std::isfinite(radius) || !finite(centre)) return false;
    const bool directional = source.kind == LightKind::directional;
    const glm::vec3 along = directional ? glm::normalize(source.direction_world) : centre - source.position_world;
    const float distance = directional ? 2 * radius : glm::length(along);
    if (!(distance > 1.05F * radius) || !std::isfinite(distance)) return false;
    const glm::vec3 axis = directional ? along : along / distance;
    const glm::vec3 up = std::abs(axis.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::mat4 view = glm::lookAtRH(centre - distance * axis, centre, up);
    const float near_distance = distance - radius, far_distance = distance + radius;
    const auto side = static_cast<float>(side_texels);
    if (directional) {
        light.shadow_from_world = glm::orthoRH_NO(-radius, radius, -radius, radius, near_distance, far_distance) * view;
        light.shadow.z = 2 * radius / side;
    } else {
        const float half_radians = std::asin(radius / distance);
        light.shadow_from_world = glm::perspectiveRH_NO(2 * half_radians, 1.0F, near_distance, far_distance) * view;
        light.shadow.z = 2 * std::tan(half_radians) / side;
        light.shadow.w = 1;
    }
    light.shadow.x = static_cast<float>(index);
    const float size = std::isfinite(source.size) ? std::max(source.size, 0.0F) : 0.0F;
    // A light wider than this is an environment.
    constexpr float widest_radians = 0.5F;
    light.shadow_depth =
        glm::vec4(near_distance, far_distance,
                  directional ? std::tan(std::min(size, widest_radians)) : std::min(size, 0.5F * distance), 0);
    return true;
}

}  // namespace blush
