// Where effects take part in shading. Each hook has one signature, starts from what the house does without effects, and
// calls NAME_HOOK of every effect of this program that has it, in the order of the registry (runtime/frame/shading_part.h).
// Two hooks stand elsewhere: `visibility` in face.vert, for each vertex, and `output` in face.frag, what only a forward
// pass has.

#insert effects

// The base colour, linear.
void hook_colour(Interpolants at, inout vec3 color) {
#call colour(at, color)
}

// The fine shape that bends the vertex normal.
void hook_relief(Interpolants at, inout Relief relief) {
#call relief(at, relief)
}

// The finished record: a roughness that follows from the relief's spread, wet skin.
void hook_surface(Interpolants at, Relief relief, inout Surface s) {
#call surface(at, relief, s)
}

// Light from all around, and how much of it arrives.
Ambient hook_ambient(Surface s, vec3 mirror) {
    Ambient around = sky_and_ground(s.normal, mirror);
#call ambient(s, mirror, around)
    return around;
}

// Share of a light that arrives at the surface.
float hook_lit(Surface s, Light light, vec3 l) {
    float share = 1.0;
#call lit(s, light, l, share)
    return share;
}

// Light of a lamp that enters from elsewhere, such as the surface's other side.
vec3 hook_through(Surface s, Light light, Arriving arrives) {
    vec3 entering = vec3(0.0);
#call through(s, light, arrives, entering)
    return entering;
}

// How skin's surface splits the light of one direction, and the light from all around: the last effect's answer stands.
Split hook_split(Surface s, vec3 view, vec3 l) {
    Split split = ggx_split(s, gloss_of(s), view, l);
#call split(s, view, l, split)
    return split;
}

Lighting hook_around(Surface s, vec3 view, Ambient around) {
    Lighting lit = ggx_around(s, gloss_of(s), view, around);
#call around(s, view, around, lit)
    return lit;
}

// Light below the surface, after all of it has entered: layers add what they send up, a diffusion that has been computed
// elsewhere puts its own in the place of what enters here.
void hook_inside(Surface s, inout Lighting lit) {
#call inside(s, lit)
}
