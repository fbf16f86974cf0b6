// A wet eyeball below its lids, its iris behind the cornea.
#include "draw/eyeball.glsl"
#include "draw/iris.glsl"
#include "draw/lids.glsl"

Surface eye_surface(Interpolants at) {
    Eye eye = eye_here(at.position_world);
    vec4 color = base_color_linear;
#ifdef BASE_COLOR_MAP
    // The offset of a neighbour pixel may be none at all: levels are chosen by the surface's own derivatives.
    Uv uv = at.texture_uv[0];
    color *= textureGrad(base_color_map, uv.at + iris_offset(eye, at), uv.dx, uv.dy);
#endif
    Surface s = material_surface(model_eye, at, color);
    s.along = iris_normal(eye, s);
    s.exposed = lid_visibility(eye, s.position);
    return s;
}

Lighting eye_lighting(Surface s) {
    vec3 view = towards_camera(s.position);
    // A film of tears lies over everything: its own reflection (1.336) and nothing rougher below.
    Gloss film = Gloss(vec3(0.0207), gloss_of(s).f90, parts.tear_roughness);
    Ambient around = hook_ambient(s, reflect(-view, s.normal));
    around.white *= s.exposed;
    around.mirrored *= s.exposed;
    Lighting lit = ggx_around(s, film, view, around);
    for (int i = 0; i < counts.x; ++i) {
        Light light = lights[i];
        Arriving arrives = arriving(light, s.position);
        vec3 l = arrives.direction;
        float n_l = dot(s.normal, l);
        if (n_l <= 0.0) continue;
        vec3 radiance = arrives.radiance * hook_lit(s, light, l);
        Split split = ggx_split(s, film, view, l);
        lit.entering += split.entering * radiance * max(dot(s.along, l), 0.0) * s.exposed;
        lit.reflected += split.reflected * radiance * n_l;
    }
    lit.reflected += s.emitted;
    return lit;
}
