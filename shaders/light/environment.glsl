// Light from all around (chappuis-2011, chapter 3): diffuse by nine spherical-harmonics coefficients, mirrored by a map
// that was filtered for a series of roughnesses.

layout(binding = BLUSH_ENVIRONMENT_UNIT) uniform sampler2D environment_map;  // level: roughness, 0 to 1

// rig/light/spherical_harmonics.h: band 1 is (y, z, x). The convolution with the cosine is in the coefficients.
vec3 environment_white(vec3 n) {
    vec3 sum = 0.282094792 * ambient_sh[0].rgb;
    sum += 0.488602512 * (n.y * ambient_sh[1].rgb + n.z * ambient_sh[2].rgb + n.x * ambient_sh[3].rgb);
    sum += 1.092548431 * (n.x * n.y * ambient_sh[4].rgb + n.y * n.z * ambient_sh[5].rgb + n.x * n.z * ambient_sh[7].rgb);
    sum += 0.315391565 * (3.0 * n.z * n.z - 1.0) * ambient_sh[6].rgb;
    sum += 0.546274215 * (n.x * n.x - n.y * n.y) * ambient_sh[8].rgb;
    return max(sum, vec3(0.0));
}

vec3 environment_mirrored(vec3 direction, float roughness) {
    // environment_direction() in rig/light/spherical_harmonics.h, backwards.
    float longitude = atan(direction.x, direction.z) - environment.z;
    vec2 uv = vec2(0.5 + longitude / 6.28318530718, 0.5 - asin(clamp(direction.y, -1.0, 1.0)) / 3.14159265359);
    return environment.x * textureLod(environment_map, uv, roughness * environment.y).rgb;
}

void environment_ambient(Surface s, vec3 mirror, inout Ambient around) {
    around.white = environment_white(s.normal);
    around.mirrored = environment_mirrored(mirror, s.roughness);
}
