// Where effects take part in shading. Each hook has one signature, starts from what the house does without effects, and
// asks those that are on, in the order of the registry. An effect brings a function NAME_HOOK in a file of its room, and
// nothing else of the shading knows it by name.

#ifdef WRINKLES
#include "wrinkles/wrinkles.glsl"
#endif
#ifdef BLOOD
#include "blood/blood.glsl"
#endif
#ifdef SHADOWS
#include "light/shadow.glsl"
#endif
#ifdef TRANSLUCENCY
#include "light/translucency.glsl"
#endif
#ifdef SKIN_REFLECTION
#include "light/skin_reflection.glsl"
#endif
#ifdef ENVIRONMENT
#include "light/environment.glsl"
#endif
#ifdef AMBIENT_OCCLUSION
#include "light/occluded_ambient.glsl"
#endif

// The base colour, linear.
void hook_colour(Interpolants at, inout vec3 color) {
#ifdef BLOOD
    blood_colour(at, color);
#endif
}

// The fine shape that bends the vertex normal.
void hook_relief(Interpolants at, inout Relief relief) {
#ifdef WRINKLES
    wrinkles_relief(at, relief);
#endif
}

// The finished record: a roughness that follows from the relief's spread, wet skin.
void hook_surface(Interpolants at, Relief relief, inout Surface s) {}

// Light from all around, and how much of it arrives.
Ambient hook_ambient(Surface s, vec3 mirror) {
    Ambient around = sky_and_ground(s.normal, mirror);
#ifdef ENVIRONMENT
    environment_ambient(s, mirror, around);
#endif
#ifdef AMBIENT_OCCLUSION
    occlusion_ambient(s, mirror, around);
#endif
    return around;
}

// Share of a light that arrives at the surface.
float hook_lit(Surface s, Light light, vec3 l) {
    float share = 1.0;
#ifdef SHADOWS
    shadows_lit(s, light, l, share);
#endif
    return share;
}

// Light of a lamp that enters from elsewhere, such as the surface's other side.
vec3 hook_through(Surface s, Light light, Arriving arrives) {
    vec3 entering = vec3(0.0);
#ifdef TRANSLUCENCY
    translucency_through(s, light, arrives, entering);
#endif
    return entering;
}

// How skin's surface splits the light of one direction, and the light from all around: the last effect's answer stands.
Split hook_split(Surface s, vec3 view, vec3 l) {
    Split split = ggx_split(s, gloss_of(s), view, l);
#ifdef SKIN_REFLECTION
    reflection_split(s, view, l, split);
#endif
    return split;
}

Lighting hook_around(Surface s, vec3 view, Ambient around) {
    Lighting lit = ggx_around(s, gloss_of(s), view, around);
#ifdef SKIN_REFLECTION
    reflection_around(s, view, around, lit);
#endif
    return lit;
}

// Light below the surface, after all of it has entered: layers add what they send up, a diffusion that has been computed
// elsewhere puts its own in the place of what enters here.
void hook_inside(Surface s, inout Lighting lit) {}
