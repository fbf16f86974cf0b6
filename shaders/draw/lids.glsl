// The shade of lids and lashes on the eye, looked up where they are now.

float distance_to_segment(vec3 p, vec3 a, vec3 b) {
    vec3 along = b - a;
    float t = clamp(dot(p - a, along) / max(dot(along, along), 1e-20), 0.0, 1.0);
    return distance(p, a + t * along);
}

// Share of the light that a wall of `height` leaves at a distance from its foot, of a sky as bright everywhere: half of
// the sky is the wall's where they touch (Lambert's form factor of a long wall). Lashes and the lid's own bend hide more
// than half, so that nothing is left there.
float beside_a_wall(float d, float height) { return d * inversesqrt(d * d + height * height + 1e-20); }

// What the lids leave of the light on the eyeball.
float lid_visibility(Eye eye, vec3 place) {
    if (eye.index < 0 || parts.lids_known == 0) return 1.0;
    int first = eye.index * 2 * BLUSH_LID_POINTS;
    float nearest[2] = float[2](1e30, 1e30);
    for (int lid = 0; lid < 2; ++lid) {
        vec3 last = vec3(0.0);
        for (int i = 0; i < BLUSH_LID_POINTS; ++i) {
            int at = first + lid * BLUSH_LID_POINTS + i;
            vec3 point = (parts.world_from_lids * vec4(surface_position(parts.lid_points[at / 4][at % 4]), 1.0)).xyz;
            if (i > 0) nearest[lid] = min(nearest[lid], distance_to_segment(place, last, point));
            last = point;
        }
    }
    // Millimetres that the upper lid with its lashes, and the lower one, stand out over the eyeball.
    float upper = beside_a_wall(nearest[0] * millimetres_a_unit, 2.5), lower = beside_a_wall(nearest[1] * millimetres_a_unit, 1.0);
    return mix(1.0, upper, parts.lid_shade) * mix(1.0, lower, 0.6 * parts.lid_shade);
}
