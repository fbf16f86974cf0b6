// Second pass of SMAA (jimenez-2012, 10.4.2): how much each side of an edge takes from the other. The same integers as
// rig/antialias/smaa_weights.cpp, which says what each step means. DIAGONALS.
#include "antialias/antialias_lines.glsl"

layout(binding = BLUSH_AA_AREAS_UNIT) uniform sampler2D orthogonal_areas;
layout(binding = BLUSH_AA_DIAGONAL_AREAS_UNIT) uniform sampler2D diagonal_areas;
layout(binding = BLUSH_AA_SEARCH_UNIT) uniform sampler2D search_table;
layout(location = 0) uniform ivec2 search_steps;  // along lines, along diagonals
layout(location = 1) uniform float corner_rounding;
layout(location = 2) uniform ivec4 slices;        // of horizontal, vertical, rising and falling lines

bool edge_at(ivec2 p, int channel) {
    return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, textureSize(edges, 0))) &&
           texelFetch(edges, p, 0)[channel] > 0.5;
}

// Accurate distance search: one fetch, a quarter and an eighth of a texel off a centre, tells four edges along the line
// and four crossing ones (figure 10.9; eq. 10.5).
int distance_to_end(vec2 centre, bool to_the_right, bool transposed) {
    vec2 place = centre + vec2(to_the_right ? 1.25 : -0.25, -0.125);
    vec2 found = vec2(0.0);
    int step_count = 0;
    for (; step_count < search_steps.x; ++step_count) {
        found = round(32.0 * edges_between(place, transposed));
        // Both edges of this row weigh 28 of 32; those above the line no more than 4.
        if (found.y < 28.0 || found.x > 0.0) break;
        place.x += to_the_right ? 2.0 : -2.0;
    }
    int reach = 2 * search_steps.x - 1;
    if (step_count == search_steps.x) return reach;
    ivec2 cell = ivec2(found.x + (to_the_right ? float(BLUSH_SEARCH_TABLE_RIGHT) : 0.0), 32.0 - found.y);
    int last = 0;
    if (all(lessThan(cell, textureSize(search_table, 0)))) {  // the table is cropped where it is 0
        last = int(round(texelFetch(search_table, cell, 0).r * 255.0 / 127.0));
    }
    return min(2 * step_count + last - (to_the_right ? 0 : 1), reach);
}

// (10.2) and (10.3).
vec2 rounded(vec2 areas, int left, int right, bvec2 left_corner, bvec2 right_corner) {
    float left_share = left < right ? 1.0 : left == right ? 0.5 : 0.0;
    vec2 corners = left_share * vec2(left_corner) + (1.0 - left_share) * vec2(right_corner);
    precise vec2 factor = 1.0 - (1.0 - corner_rounding) * corners;
    return floor(round(255.0 * areas) * factor + 0.5) / 255.0;
}

// Shares of the near (x) and the far (y) side of the edge at the top of a texel of the view.
vec2 line_weights(ivec2 p, bool transposed, int slice) {
    ivec2 local = transposed ? p.yx : p;
    vec2 centre = vec2(local) + 0.5;
    int left = distance_to_end(centre, false, transposed), right = distance_to_end(centre, true, transposed);
    vec2 left_end = centre - vec2(left, 0.0), right_end = centre + vec2(right + 1, 0.0);
    ivec2 place = BLUSH_ORTHOGONAL_DISTANCES * ivec2(crossing_at(left_end, transposed), crossing_at(right_end, transposed)) +
                  ivec2(left, right);
    vec2 areas = texelFetch(orthogonal_areas, place + ivec2(0, slice * 5 * BLUSH_ORTHOGONAL_DISTANCES), 0).rg;
    if (corner_rounding == 1.0) return areas;
    // Crossing edges two pixels long: the second pixel below, and above.
    ivec2 left_texel = ivec2(left_end), right_texel = ivec2(right_end);
    int channel = transposed ? 1 : 0;
#define CROSSES(texel) edge_at(transposed ? (texel).yx : (texel), channel)
    bvec2 left_corner = bvec2(CROSSES(left_texel + ivec2(0, 1)), CROSSES(left_texel - ivec2(0, 2)));
    bvec2 right_corner = bvec2(CROSSES(right_texel + ivec2(0, 1)), CROSSES(right_texel - ivec2(0, 2)));
#undef CROSSES
    return rounded(areas, left, right, left_corner, right_corner);
}

#ifdef DIAGONALS
// A view of the edges around one, in which it is the upper edge of pixel (0, 0) and a staircase climbs to the upper right.
struct View {
    ivec2 origin, along_i, along_j, left_shift;
    int upper_channel;
};
bool upper(View view, int i, int j) {
    return edge_at(view.origin + i * view.along_i + j * view.along_j, view.upper_channel);
}
bool left(View view, int i, int j) {
    return edge_at(view.origin + i * view.along_i + j * view.along_j + view.left_shift, 1 - view.upper_channel);
}

struct Staircase {
    int lower, upper;          // whole steps to both sides
    int lower_end, upper_end;  // DiagonalEnd of rig/antialias/line_areas.h
    int edges;
};

Staircase find_staircase(View view) {
    Staircase stairs = Staircase(0, 0, 0, 0, 1);
    for (; stairs.upper < search_steps.y; ++stairs.upper) {
        int k = stairs.upper;
        if (!left(view, k + 1, -k - 1)) {
            stairs.upper_end = upper(view, k + 1, -k) ? 1 : 0;
            break;
        }
        ++stairs.edges;
        if (!upper(view, k + 1, -k - 1)) {
            stairs.upper_end = left(view, k + 1, -k - 2) ? 2 : 0;
            break;
        }
        ++stairs.edges;
    }
    for (; stairs.lower < search_steps.y; ++stairs.lower) {
        int k = stairs.lower;
        if (!left(view, -k, k)) {
            stairs.lower_end = upper(view, -k - 1, k) ? 1 : 0;
            break;
        }
        ++stairs.edges;
        if (!upper(view, -k - 1, k + 1)) {
            stairs.lower_end = left(view, -k, k + 1) ? 2 : 0;
            break;
        }
        ++stairs.edges;
    }
    return stairs;
}

// False where there is no staircase, or where two meet.
bool diagonal_weights(View view, View mirrored, bool swap_mirrored, out vec2 areas) {
    Staircase up = find_staircase(view), down = find_staircase(mirrored);
    bool is_up = up.edges >= BLUSH_FEWEST_DIAGONAL_EDGES, is_down = down.edges >= BLUSH_FEWEST_DIAGONAL_EDGES;
    areas = vec2(0.0);
    if (is_up == is_down) return false;
    Staircase stairs = up;
    if (is_down) stairs = down;
    ivec2 place = BLUSH_DIAGONAL_DISTANCES * ivec2(stairs.lower_end, stairs.upper_end) + ivec2(stairs.lower, stairs.upper);
    int slice = is_up ? slices.z : slices.w;
    areas = texelFetch(diagonal_areas, place + ivec2(0, slice * 4 * BLUSH_DIAGONAL_DISTANCES), 0).rg;
    if (is_down && swap_mirrored) areas = areas.yx;
    return true;
}
#endif

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec2 here = texelFetch(edges, p, 0).rg;
    weights = vec4(0.0);
    if (here.g > 0.0) {
#ifdef DIAGONALS
        View view = View(p, ivec2(1, 0), ivec2(0, 1), ivec2(0, 0), 1);
        View mirrored = View(p, ivec2(-1, 0), ivec2(0, 1), ivec2(1, 0), 1);
        if (!diagonal_weights(view, mirrored, false, weights.rg))
#endif
            weights.rg = line_weights(p, false, slices.x);
    }
    if (here.r > 0.0) {
#ifdef DIAGONALS
        View view = View(p, ivec2(0, 1), ivec2(1, 0), ivec2(0, 0), 0);
        View mirrored = View(p, ivec2(0, 1), ivec2(-1, 0), ivec2(-1, 0), 0);
        if (!diagonal_weights(view, mirrored, true, weights.ba))
#endif
            weights.ba = line_weights(p, true, slices.y);
    }
}
