// Normals of the vertices whose targets have none of their own: the rest normal turned with the deformed surface.
// Twin of rig/deform/surface_normals.cpp.
#include "shared.glsl"
#include "deform/surface_normals.glsl"

layout(location = BLUSH_REST_NORMAL_ATTRIBUTE) in vec3 rest_normal;
layout(location = BLUSH_REST_TANGENT_ATTRIBUTE) in vec4 rest_tangent;
layout(location = BLUSH_REST_SUM_ATTRIBUTE) in vec3 rest_sum;

layout(std430, binding = BLUSH_POSITIONS_BINDING) readonly buffer Positions { float positions[]; };
layout(std430, binding = BLUSH_FIRST_TRIANGLE_BINDING) readonly buffer FirstTriangle { uint first_triangle[]; };
layout(std430, binding = BLUSH_TRIANGLES_BINDING) readonly buffer Triangles { uint triangles[]; };

out vec3 deformed_normal;
out vec4 deformed_tangent;

vec3 position_of(uint vertex) {
    return vec3(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u]);
}

void main() {
    precise vec3 sum = vec3(0.0);
    uint last = first_triangle[gl_VertexID + 1];
    for (uint i = first_triangle[gl_VertexID]; i < last; ++i) {
        vec3 a = position_of(triangles[3u * i]);
        precise vec3 ab = position_of(triangles[3u * i + 1u]) - a;
        precise vec3 ac = position_of(triangles[3u * i + 2u]) - a;
        sum += angle_times_normal(ab, ac);
    }
    vec3 n = turned_normal(rest_normal, rest_sum, sum);
    vec4 t = rest_tangent;
    if (n != rest_normal) t = orthogonal_tangent(rest_tangent, n, rest_tangent);
    deformed_normal = n;
    deformed_tangent = t;
}
