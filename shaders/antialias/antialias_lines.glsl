// What the weight passes of MLAA and SMAA share: the edges texture, looked at as it is or with x and y exchanged, so
// that lines of both directions are one piece of code.
#include "shared.glsl"

// Bilinear, with a border without edges.
layout(binding = BLUSH_AA_EDGES_UNIT) uniform sampler2D edges;
// r, g: shares of the pixels below and above the upper edge; b, a: right and left of the left edge.
layout(location = 0) out vec4 weights;

// Crossing edges (x) and edges along the line (y) at a place between texel centres, in texels of a view in which the
// line is horizontal.
vec2 edges_between(vec2 place, bool transposed) {
    vec2 e = textureLod(edges, (transposed ? place.yx : place) / vec2(textureSize(edges, 0)), 0.0).rg;
    return transposed ? e.yx : e;
}

// Which edges cross the line at the left boundary of the texel with this centre: 0 none, 1 above, 3 below, 4 both
// (figure 9.4).
int crossing_at(vec2 centre, bool transposed) {
    return int(round(4.0 * edges_between(centre - vec2(0.0, 0.25), transposed).x));
}
