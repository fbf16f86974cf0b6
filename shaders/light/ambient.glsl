// Light from all around.

struct Ambient {
    vec3 white;     // radiance that a white surface reflects
    vec3 mirrored;  // radiance that a mirror as rough as the surface shows
};

Ambient sky_and_ground(vec3 normal, vec3 mirror) {
    return Ambient(mix(ground_radiance_linear.rgb, sky_radiance_linear.rgb, 0.5 + 0.5 * normal.y),
                   mix(ground_radiance_linear.rgb, sky_radiance_linear.rgb, 0.5 + 0.5 * mirror.y));
}
