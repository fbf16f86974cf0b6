// Light from all around.

struct Ambient {
    vec3 white;     // radiance that a white surface reflects
    vec3 mirrored;  // radiance that a mirror as rough as the surface shows
};

// Nine spherical-harmonics coefficients in a direction (rig/light/spherical_harmonics.h: band 1 is (y, z, x)).
vec3 sum_of_sh(vec3 n, vec4 coefficients[9]) {
    vec3 sum = 0.282094792 * coefficients[0].rgb;
    sum += 0.488602512 * (n.y * coefficients[1].rgb + n.z * coefficients[2].rgb + n.x * coefficients[3].rgb);
    sum += 1.092548431 *
           (n.x * n.y * coefficients[4].rgb + n.y * n.z * coefficients[5].rgb + n.x * n.z * coefficients[7].rgb);
    sum += 0.315391565 * (3.0 * n.z * n.z - 1.0) * coefficients[6].rgb;
    sum += 0.546274215 * (n.x * n.x - n.y * n.y) * coefficients[8].rgb;
    return sum;
}

Ambient sky_and_ground(vec3 normal, vec3 mirror) {
    return Ambient(mix(ground_radiance_linear.rgb, sky_radiance_linear.rgb, 0.5 + 0.5 * normal.y),
                   mix(ground_radiance_linear.rgb, sky_radiance_linear.rgb, 0.5 + 0.5 * mirror.y));
}
