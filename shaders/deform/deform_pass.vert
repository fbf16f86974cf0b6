// Blend shapes by repeated stream-out passes of a few dense targets each: the scheme of jimenez-2012, 7.6 and 8.3
// (after Lorach 2007), kept as the plainer twin of deform.vert.
#include "shared.glsl"
#include "deform/surface_normals.glsl"

layout(location = BLUSH_POSITION_ATTRIBUTE) in vec3 position;  // at rest, or what the pass before left
layout(location = BLUSH_NORMAL_ATTRIBUTE) in vec3 normal;
layout(location = BLUSH_TANGENT_ATTRIBUTE) in vec4 tangent;
layout(location = BLUSH_REST_NORMAL_ATTRIBUTE) in vec3 rest_normal;
layout(location = BLUSH_REST_TANGENT_ATTRIBUTE) in vec4 rest_tangent;

#ifdef HAS_TANGENT_DELTAS
#define TARGETS_A_PASS BLUSH_TARGETS_A_PASS_WITH_TANGENTS
#define ATTRIBUTES_A_TARGET 3
#else
#define TARGETS_A_PASS BLUSH_TARGETS_A_PASS
#define ATTRIBUTES_A_TARGET 2
#endif
layout(location = BLUSH_TARGET_ATTRIBUTE) in vec3 deltas[TARGETS_A_PASS * ATTRIBUTES_A_TARGET];

layout(location = 0) uniform float weights[TARGETS_A_PASS];
layout(location = 4) uniform int target_count;
layout(location = 5) uniform bool last_pass;
layout(location = 6) uniform bool recomputed;

#include "deform/deform_finish.glsl"

void main() {
    precise vec3 p = position;
    precise vec3 n = normal;
    precise vec3 t = tangent.xyz;
    for (int k = 0; k < TARGETS_A_PASS; ++k) {
        if (k >= target_count) break;
        p += weights[k] * deltas[ATTRIBUTES_A_TARGET * k];
        n += weights[k] * deltas[ATTRIBUTES_A_TARGET * k + 1];
#ifdef HAS_TANGENT_DELTAS
        t += weights[k] * deltas[ATTRIBUTES_A_TARGET * k + 2];
#endif
    }
    deformed_position = p;
    finish_deformation(n, vec4(t, tangent.w), last_pass, recomputed, rest_normal, rest_tangent);
}
