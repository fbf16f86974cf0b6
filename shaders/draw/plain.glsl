// What is no part of a head that has a model of its own: glTF's material as it stands.

Surface plain_surface(Interpolants at) { return material_surface(model_plain, at, material_color(at)); }

Lighting plain_lighting(Surface s) {
    vec3 view = towards_camera(s.position);
    Gloss gloss = gloss_of(s);
    Lighting lit = ggx_around(s, gloss, view, hook_ambient(s, reflect(-view, s.normal)));
    for (int i = 0; i < counts.x; ++i) {
        Light light = lights[i];
        Arriving arrives = arriving(light, s.position);
        float n_l = dot(s.normal, arrives.direction);
        if (n_l <= 0.0) continue;
        vec3 radiance = arrives.radiance * hook_lit(s, light, arrives.direction);
        Split split = ggx_split(s, gloss, view, arrives.direction);
        lit.entering += split.entering * radiance * n_l;
        lit.reflected += split.reflected * radiance * n_l;
    }
    lit.reflected += s.emitted;
    return lit;
}
