// Second pass of MLAA (jimenez-2012, 9.4): the same integers as rig/antialias/mlaa_weights.cpp.
#include "antialias/antialias_lines.glsl"

layout(binding = BLUSH_AA_AREAS_UNIT) uniform sampler2D areas;
layout(location = 0) uniform int search_steps;

// Listing 9.3: one fetch between two texels tells whether both have an edge.
int distance_to_end(vec2 centre, float direction, bool transposed) {
    vec2 place = centre + vec2(1.5 * direction, 0.0);
    for (int i = 0; i < search_steps; ++i) {
        int found = int(round(2.0 * edges_between(place, transposed).y));
        if (found < 2) return 2 * i + found;
        place.x += 2.0 * direction;
    }
    return 2 * search_steps;
}

// Listings 9.2 and 9.4.
vec2 line_weights(ivec2 p, bool transposed) {
    vec2 centre = vec2(transposed ? p.yx : p) + 0.5;
    int left = distance_to_end(centre, -1.0, transposed), right = distance_to_end(centre, 1.0, transposed);
    ivec2 crossings = ivec2(crossing_at(centre - vec2(left, 0.0), transposed),
                            crossing_at(centre + vec2(right + 1, 0.0), transposed));
    return texelFetch(areas, BLUSH_MLAA_DISTANCES * crossings + ivec2(left, right), 0).rg;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec2 here = texelFetch(edges, p, 0).rg;
    weights = vec4(0.0);
    if (here.g > 0.0) weights.rg = line_weights(p, false);
    if (here.r > 0.0) weights.ba = line_weights(p, true);
}
