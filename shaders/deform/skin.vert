// Joints, applied after the morph (glTF 2.0, 3.7.3.3). Twin of skin() in rig/deform/deform.cpp.
#include "shared.glsl"
#include "deform/surface_normals.glsl"

layout(location = BLUSH_POSITION_ATTRIBUTE) in vec3 position;
layout(location = BLUSH_NORMAL_ATTRIBUTE) in vec3 normal;
layout(location = BLUSH_TANGENT_ATTRIBUTE) in vec4 tangent;
layout(location = BLUSH_JOINTS_ATTRIBUTE) in uvec4 joints;
layout(location = BLUSH_JOINT_WEIGHTS_ATTRIBUTE) in vec4 joint_weights;

layout(std430, binding = BLUSH_JOINTS_BINDING) readonly buffer Joints { mat4 skinned_from_mesh[]; };
layout(location = 0) uniform uint first_joint;

out vec3 deformed_position;
out vec3 deformed_normal;
out vec4 deformed_tangent;

void main() {
    deformed_position = position;
    deformed_normal = normal;
    deformed_tangent = tangent;
    if (joint_weights == vec4(0.0)) return;
    mat4 blended = mat4(0.0);
    for (int i = 0; i < 4; ++i) {
        if (joint_weights[i] != 0.0) blended += joint_weights[i] * skinned_from_mesh[first_joint + joints[i]];
    }
    deformed_position = (blended * vec4(position, 1.0)).xyz;
    mat3 turn = mat3(blended);
    deformed_normal = normalized_or(turn * normal, normal);
    deformed_tangent = orthogonal_tangent(vec4(turn * tangent.xyz, tangent.w), deformed_normal, tangent);
}
