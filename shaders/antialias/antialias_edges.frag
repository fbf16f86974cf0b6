// First pass of MLAA and SMAA: edges at the left (red) and upper (green) boundary of each texel (jimenez-2012, 9.3 and
// 10.4.1). "Up" is towards row 0 of the texture. The same sums in the same order as rig/antialias/edges.cpp.
// EDGES_FROM_LUMA, EDGES_FROM_COLOR or EDGES_FROM_DEPTH; PREDICATED.
#include "shared.glsl"

layout(binding = BLUSH_AA_COLOR_UNIT) uniform sampler2D color;
layout(binding = BLUSH_AA_DEPTH_UNIT) uniform sampler2D depth;
layout(location = 0) uniform vec2 threshold_contrast;  // threshold, contrast factor
layout(location = 1) uniform vec3 predication;         // depth threshold, scale, strength
layout(location = 2) uniform ivec2 meaning;            // 1: linear light; 0 carried, 1 straight, 2 premultiplied alpha
layout(location = 0) out vec2 edges;

// As in rig/antialias/edges.cpp.
const float same_contrast = 1e-6;

// False for NaN, which counts as 0.
float clean(float value) { return value > 0.0 ? min(value, 65504.0) : 0.0; }

ivec2 inside(ivec2 p, ivec2 size) { return clamp(p, ivec2(0), size - 1); }

float depth_at(ivec2 p) { return clean(texelFetch(depth, inside(p, textureSize(depth, 0)), 0).r); }

#ifdef EDGES_FROM_DEPTH
vec4 signal(ivec2 p) { return vec4(depth_at(p), 0.0, 0.0, 0.0); }
#else
float shown(float channel, float alpha) {
    precise float value = clean(channel);
    if (meaning.y == 1) value *= alpha;
    return meaning.x != 0 ? sqrt(value) : value;
}

vec4 signal(ivec2 p) {
    vec4 texel = texelFetch(color, inside(p, textureSize(color, 0)), 0);
    float alpha = min(clean(texel.a), 1.0);
    float coverage = meaning.y == 0 ? 0.0 : alpha;
    vec3 c = vec3(shown(texel.r, alpha), shown(texel.g, alpha), shown(texel.b, alpha));
#ifdef EDGES_FROM_COLOR
    return vec4(c, coverage);
#else
    precise float luma = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;  // (9.2)
    return vec4(luma, 0.0, 0.0, coverage);
#endif
}
#endif

float contrast(vec4 a, vec4 b) {
    vec4 difference = abs(a - b);
    return max(max(difference.x, difference.y), max(difference.z, difference.w));
}

float threshold_between(ivec2 p, ivec2 other) {
#ifdef PREDICATED
    bool silhouette = abs(depth_at(p) - depth_at(other)) > predication.x;
    precise float threshold = threshold_contrast.x * predication.y * (1.0 - (silhouette ? predication.z : 0.0));
    return threshold;
#else
    return threshold_contrast.x;
#endif
}

bool is_edge(float contrast, float threshold, float greatest) {
    precise float beyond = contrast - threshold;
#ifdef EDGES_FROM_DEPTH
    return beyond > same_contrast;
#else
    precise float share = threshold_contrast.y * greatest;
    precise float above = contrast - share;
    return beyond > same_contrast && above > same_contrast;  // (10.1)
#endif
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 here = signal(p), left = signal(p - ivec2(1, 0)), top = signal(p - ivec2(0, 1));
    float to_left = contrast(here, left), to_top = contrast(here, top);
    float around = max(max(to_left, contrast(here, signal(p + ivec2(1, 0)))),
                       max(to_top, contrast(here, signal(p + ivec2(0, 1)))));
    float left_of_left = contrast(left, signal(p - ivec2(2, 0)));
    float top_of_top = contrast(top, signal(p - ivec2(0, 2)));
    bvec2 found = bvec2(is_edge(to_left, threshold_between(p, p - ivec2(1, 0)), max(around, left_of_left)),
                        is_edge(to_top, threshold_between(p, p - ivec2(0, 1)), max(around, top_of_top)));
    edges = vec2(found);
}
