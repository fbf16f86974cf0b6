// Moves what lies around pins to them. Twin of apply_pins() in rig/deform/pinning.cpp; one invocation a vertex of the
// ring. `to` is a copy of `from` at first.
#include "shared.glsl"
#include "deform/surface_normals.glsl"

layout(local_size_x = BLUSH_PIN_INVOCATIONS) in;

layout(std430, binding = BLUSH_PIN_FROM_POSITIONS_BINDING) readonly buffer FromPositions { float from_positions[]; };
layout(std430, binding = BLUSH_PIN_FROM_NORMALS_BINDING) readonly buffer FromNormals { float from_normals[]; };
layout(std430, binding = BLUSH_PIN_TO_POSITIONS_BINDING) buffer ToPositions { float to_positions[]; };
layout(std430, binding = BLUSH_PIN_TO_NORMALS_BINDING) buffer ToNormals { float to_normals[]; };
layout(std430, binding = BLUSH_PIN_TO_TANGENTS_BINDING) buffer ToTangents { float to_tangents[]; };
// Pins, 8 values each: position, vertex, normal, nothing. Then the ring, 10 each: vertex, influence, 4 pins, 4 weights.
layout(std430, binding = BLUSH_PINS_BINDING) readonly buffer Pins { uint pins[]; };

layout(location = 0) uniform uint first_of_ring;  // in `pins`
layout(location = 1) uniform uint ring_count;

const uint no_vertex = 0xffffffffu;

vec3 three(uint at) { return vec3(uintBitsToFloat(pins[at]), uintBitsToFloat(pins[at + 1u]), uintBitsToFloat(pins[at + 2u])); }

void main() {
    if (gl_GlobalInvocationID.x >= ring_count) return;
    uint entry = first_of_ring + 10u * gl_GlobalInvocationID.x;
    uint v = pins[entry];
    float influence = uintBitsToFloat(pins[entry + 1u]);
    vec3 normal = vec3(from_normals[3u * v], from_normals[3u * v + 1u], from_normals[3u * v + 2u]);
    vec3 position, pinned_normal;
    if (influence == 1.0) {
        uint pin = 8u * pins[entry + 2u];
        if (pins[pin + 3u] == no_vertex) return;
        position = three(pin);
        pinned_normal = three(pin + 4u);
    } else {
        precise vec3 move = vec3(0.0);
        precise vec3 turn = vec3(0.0);
        for (uint k = 0u; k < 4u; ++k) {
            uint pin = 8u * pins[entry + 2u + k];
            float weight = uintBitsToFloat(pins[entry + 6u + k]);
            uint at = pins[pin + 3u];
            if (weight == 0.0 || at == no_vertex) continue;
            move += weight * (three(pin) - vec3(from_positions[3u * at], from_positions[3u * at + 1u], from_positions[3u * at + 2u]));
            turn += weight * (three(pin + 4u) - vec3(from_normals[3u * at], from_normals[3u * at + 1u], from_normals[3u * at + 2u]));
        }
        if (move == vec3(0.0) && turn == vec3(0.0)) return;
        precise vec3 moved = vec3(from_positions[3u * v], from_positions[3u * v + 1u], from_positions[3u * v + 2u]) + influence * move;
        precise vec3 turned = normal + influence * turn;
        position = moved;
        pinned_normal = turn == vec3(0.0) ? normal : normalized_or(turned, normal);
    }
    for (uint c = 0u; c < 3u; ++c) to_positions[3u * v + c] = position[c];
    if (pinned_normal == normal) return;  // what does not turn keeps its bits
    vec4 tangent = vec4(to_tangents[4u * v], to_tangents[4u * v + 1u], to_tangents[4u * v + 2u], to_tangents[4u * v + 3u]);
    tangent = orthogonal_tangent(tangent, pinned_normal, tangent);
    for (uint c = 0u; c < 3u; ++c) {
        to_normals[3u * v + c] = pinned_normal[c];
        to_tangents[4u * v + c] = tangent[c];
    }
}
