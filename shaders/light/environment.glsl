// Light from all around (chappuis-2011, chapter 3): diffuse by nine spherical-harmonics coefficients, mirrored by a map
// that was filtered for a series of roughnesses.

layout(binding = ENVIRONMENT_UNIT) uniform sampler2D environment_map;  // level: roughness, 0 to 1

vec3 environment_mirrored(vec3 direction, float roughness) {
    // environment_direction() in rig/light/spherical_harmonics.h, backwards.
    float longitude = atan(direction.x, direction.z) - environment.turn;
    vec2 uv = vec2(0.5 + longitude / 6.28318530718, 0.5 - asin(clamp(direction.y, -1.0, 1.0)) / 3.14159265359);
    return environment.factor * textureLod(environment_map, uv, roughness * environment.last_level).rgb;
}

void environment_ambient(Surface s, vec3 mirror, inout Ambient around) {
    around.white = max(sum_of_sh(s.normal, ambient_sh), vec3(0.0));  // the cosine's convolution is in them
    around.mirrored = environment_mirrored(mirror, s.roughness);
}
