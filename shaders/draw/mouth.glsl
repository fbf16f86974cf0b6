// Teeth, gums and tongue: wet, and behind lips.

// What is left of the light behind the lips: it falls with the depth behind the foremost tooth by how much of an opening
// 50 mm wide is seen from there, 1 / (1 + (d / r)^2) of a disc's. Occlusion and shadows do the rest.
float mouth_visibility(vec3 position) {
    float depth_mm = max(dot(parts.mouth_front.xyz - position, parts.mouth_forward.xyz) * millimetres_a_unit, 0.0);
    return mix(1.0, 1.0 / (1.0 + depth_mm * depth_mm / (25.0 * 25.0)), parts.mouth_shade);
}

Surface mouth_surface(Interpolants at) {
    Surface s = material_surface(model_mouth, at, material_color(at));
    s.exposed = mouth_visibility(s.position);
    return s;
}

Lighting mouth_lighting(Surface s) {
    vec3 view = towards_camera(s.position);
    Gloss gloss = gloss_of(s);
    Lighting lit = ggx_around(s, gloss, view, hook_ambient(s, reflect(-view, s.normal)));
    for (int i = 0; i < counts.x; ++i) {
        Light light = lights[i];
        Arriving arrives = arriving(light, s.position);
        vec3 l = arrives.direction;
        float n_l = dot(s.normal, l);
        if (n_l <= 0.0) continue;
        // Wet lips and enamel hand light on: in the shadow of a lip teeth are half as bright, not black. Light from behind
        // has the head before it, and none of it gets there.
        float handed_on = 0.5 * smoothstep(0.0, 0.5, dot(l, parts.mouth_forward.xyz));
        vec3 radiance = arrives.radiance * mix(handed_on, 1.0, hook_lit(s, light, l));
        Split split = ggx_split(s, gloss, view, l);
        lit.entering += split.entering * radiance * n_l;
        lit.reflected += split.reflected * radiance * n_l;
    }
    lit.entering *= s.exposed;
    lit.reflected *= s.exposed;
    lit.reflected += s.emitted;
    return lit;
}
