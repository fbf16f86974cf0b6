// Light through thin parts (jimenez-2012, chapter 5), from the thickness that a light's shadow map tells.

// Share of the light's radiance that comes out here.
vec3 transmitted(Light light, InMap map, vec3 l, vec3 vertex_normal) {
    // The reversed vertex normal, some 17 degrees early so that it meets what the front reflects (eq. 5.13).
    float back = max(0.3 - dot(vertex_normal, l), 0.0);
    if (back == 0.0 || light.shadow.x < 0.0) return vec3(0.0);
    float thickness_mm =
        depth_inside(light, map.here - map.along_normal * (translucency.drawn_in_mm / millimetres_a_unit), translucency.thickest_mm / millimetres_a_unit) * millimetres_a_unit;
    // The paper leaves the thickness short by what the point was drawn in; a slab has it all, up to 45 degrees from its
    // normal. Where light grazes more, a surface is no slab's, and its own depth is the better guess.
    float facing_away = max(-dot(vertex_normal, l), 0.0), bounded = max(facing_away, 0.7);
    thickness_mm += translucency.drawn_in_mm * facing_away / (bounded * bounded);
    if (!(thickness_mm < translucency.thickest_mm)) return vec3(0.0);
    vec3 passed = vec3(0.0);  // T(s), eq. 5.12
    for (int k = 0; k < BLUSH_MOST_GAUSSIANS; ++k) {
        passed += translucency.profile[k].rgb * exp(thickness_mm * thickness_mm * translucency.profile[k].w);
    }
    return translucency.strength * back * passed;
}

void translucency_through(Surface s, Light light, Arriving arrives, inout vec3 entering) {
    entering += arrives.radiance * transmitted(light, in_map(light, s), arrives.direction, s.vertex_normal);
}
