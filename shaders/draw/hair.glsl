// Hair, brows and lashes: cards that stand for strands.
#include "draw/strands.glsl"

Surface hair_surface(Interpolants at) {
    Surface s = material_surface(model_hair, at, material_color(at));
    s.along = strand_direction(at, s.normal);
    // What the texture has darker than the material's colour lies among other strands.
    vec3 whole = max(base_color_linear.rgb, vec3(1e-4));
    s.exposed = clamp(dot(s.base_color / whole, vec3(1.0 / 3.0)), 0.0, 1.0);
    return s;
}

Lighting hair_lighting(Surface s) {
    vec3 view = towards_camera(s.position);
    // A cylinder mirrors all directions across it, and has passed most of what is left through its own colour.
    vec3 passed = sqrt(s.base_color);
    Ambient around = hook_ambient(s, reflect(-view, s.normal));
    Lighting lit = Lighting(around.white * s.occlusion, 0.046 * passed * around.mirrored * s.occlusion, vec3(1.0));
    for (int i = 0; i < counts.x; ++i) {
        Light light = lights[i];
        Arriving arrives = arriving(light, s.position);
        vec3 l = arrives.direction;
        if (dot(s.normal, l) <= -strands_wrap) continue;
        // Strands hide a part of the light from each other and send most of it on.
        vec3 radiance = arrives.radiance * mix(0.3, 1.0, hook_lit(s, light, l));
        vec3 shares = strand_shares(s.along, s.normal, l, view);
        lit.entering += radiance * shares.x;
        lit.reflected += pi * radiance * (shares.y * s.exposed + shares.z * passed);
    }
    lit.reflected += s.emitted;
    return lit;
}
