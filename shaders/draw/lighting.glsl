// What the lighting half of a model gives.

// Light on its way through a surface. Diffusion takes place between entering and leaving: on the screen, in texture space
// (which needs `entering` alone, and hands back what hook_inside() reads), or in layers below.
struct Lighting {
    vec3 entering;   // radiance that white would reflect, of the light that is left for the inside; before any albedo
    vec3 reflected;  // radiance from the surface itself: reflected and emitted
    vec3 leaving;    // share of the light from inside that the surface lets out again
};

// What a surface does with the light of one direction.
struct Split {
    vec3 entering, reflected;  // over the light's radiance (of white that faces it) times n.l
};

vec3 light_from_inside(Surface s, Lighting lit) { return diffuse_color(s) * lit.entering * lit.leaving; }
