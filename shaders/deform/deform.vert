// Blend shapes by stream-out in one pass over the sparse deltas of the active targets.
// jimenez-2012, 7.6 and 8.3 (there: repeated passes of four dense targets, deform_pass.vert here).
// Twin of rig/deform/blend_shapes.cpp and rig/deform/deform.cpp: the same sum in the same order.
#include "shared.glsl"
#include "deform/surface_normals.glsl"

layout(location = BLUSH_POSITION_ATTRIBUTE) in vec3 position;  // at rest, or what an earlier page of deltas left
layout(location = BLUSH_NORMAL_ATTRIBUTE) in vec3 normal;
layout(location = BLUSH_TANGENT_ATTRIBUTE) in vec4 tangent;
layout(location = BLUSH_REST_NORMAL_ATTRIBUTE) in vec3 rest_normal;
layout(location = BLUSH_REST_TANGENT_ATTRIBUTE) in vec4 rest_tangent;

layout(std430, binding = BLUSH_FIRST_ENTRY_BINDING) readonly buffer FirstEntry { uint first_entry[]; };
layout(std430, binding = BLUSH_ENTRIES_BINDING) readonly buffer Entries { uint entries[]; };  // delta, mask, slot
layout(std430, binding = BLUSH_WEIGHTS_BINDING) readonly buffer Weights { float weights[]; };
layout(std430, binding = BLUSH_POSITION_DELTAS_BINDING) readonly buffer PositionDeltas { float position_deltas[]; };
layout(std430, binding = BLUSH_NORMAL_DELTAS_BINDING) readonly buffer NormalDeltas { float normal_deltas[]; };
layout(std430, binding = BLUSH_TANGENT_DELTAS_BINDING) readonly buffer TangentDeltas { float tangent_deltas[]; };

layout(location = 0) uniform uint first_delta_of_page;
layout(location = 1) uniform bool last_page;
layout(location = 2) uniform bool recomputed;  // the normals pass writes normal and tangent of these vertices

#include "deform/deform_finish.glsl"

void main() {
    uint block = uint(gl_VertexID) >> 5;
    uint lane_bit = 1u << (uint(gl_VertexID) & 31u);

    precise vec3 p = position;
    precise vec3 n = normal;
    precise vec3 t = tangent.xyz;
    uint last = first_entry[block + 1u];
    for (uint i = first_entry[block]; i < last; ++i) {
        uint mask = entries[3u * i + 1u];
        if ((mask & lane_bit) == 0u) continue;
        uint at = 3u * (entries[3u * i] - first_delta_of_page + uint(bitCount(mask & (lane_bit - 1u))));
        float weight = weights[entries[3u * i + 2u]];
        p += weight * vec3(position_deltas[at], position_deltas[at + 1u], position_deltas[at + 2u]);
#ifdef HAS_NORMAL_DELTAS
        n += weight * vec3(normal_deltas[at], normal_deltas[at + 1u], normal_deltas[at + 2u]);
#endif
#ifdef HAS_TANGENT_DELTAS
        t += weight * vec3(tangent_deltas[at], tangent_deltas[at + 1u], tangent_deltas[at + 2u]);
#endif
    }
    deformed_position = p;
    finish_deformation(n, vec4(t, tangent.w), last_page, recomputed, rest_normal, rest_tangent);
}
