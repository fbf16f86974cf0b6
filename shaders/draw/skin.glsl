// Skin (jimenez-2012, chapters 5 and 6; chappuis-2011, chapters 2 and 3): light is reflected at the surface, enters,
// wanders below, and leaves.

Surface skin_surface(Interpolants at) {
    Surface s = material_surface(model_skin, at, material_color(at));
    if (alpha.z != 0.0) s.scatter = s.opacity;
    return s;
}

Lighting skin_lighting(Surface s) {
    vec3 view = towards_camera(s.position);
    Lighting lit = hook_around(s, view, hook_ambient(s, reflect(-view, s.normal)));
    for (int i = 0; i < counts.x; ++i) {
        Light light = lights[i];
        Arriving arrives = arriving(light, s.position);
        lit.entering += hook_through(s, light, arrives);
        float n_l = dot(s.normal, arrives.direction);
        if (n_l <= 0.0) continue;
        vec3 radiance = arrives.radiance * hook_lit(s, light, arrives.direction);
        Split split = hook_split(s, view, arrives.direction);
        lit.entering += split.entering * radiance * n_l;
        lit.reflected += split.reflected * radiance * n_l;
    }
    hook_inside(s, lit);
    lit.reflected += s.emitted;
    return lit;
}
