// Places the deformed surface in the world. Reads what the deformation passes wrote; deforms nothing itself.
#include "shared.glsl"
#insert uniforms

layout(location = BLUSH_POSITION_ATTRIBUTE) in vec3 position;
layout(location = BLUSH_NORMAL_ATTRIBUTE) in vec3 normal;
layout(location = BLUSH_TANGENT_ATTRIBUTE) in vec4 tangent;
layout(location = BLUSH_UV0_ATTRIBUTE) in vec2 uv0;
layout(location = BLUSH_UV1_ATTRIBUTE) in vec2 uv1;

// The core of hair is drawn twice, the second time where its depth is what the first one left.
invariant gl_Position;

centroid out vec3 position_world;
centroid out vec3 normal_world;
centroid out vec4 tangent_world;
centroid out vec2 layout_uv;      // of the face's own maps
centroid out vec2 texture_uv[6];  // of each texture of the material, in the order of MaterialBlock
#ifdef CALLS_VISIBILITY
centroid out vec4 ambient_visibility;  // rgb: share of the ambient light that arrives; a: share of the open directions
#endif
#insert vertex_effects

vec2 transformed(int texture_index, int uv_set) {
    vec3 uv = vec3(uv_set == 1 ? uv1 : uv0, 1.0);
    return vec2(dot(uv_rows[2 * texture_index].xyz, uv), dot(uv_rows[2 * texture_index + 1].xyz, uv));
}

void main() {
    vec4 world = world_from_mesh * vec4(position, 1.0);
    position_world = world.xyz;
    normal_world = mat3(world_normal_from_mesh) * normal;
    tangent_world = vec4(mat3(world_from_mesh) * tangent.xyz, tangent.w);
    for (int i = 0; i < 4; ++i) texture_uv[i] = transformed(i, uv_sets[i]);
    texture_uv[4] = transformed(4, emissive_uv_set.x);
    texture_uv[5] = transformed(5, emissive_uv_set.y);
    layout_uv = uv0;
#ifdef CALLS_VISIBILITY
    vec4 visibility = vec4(1.0);
#call visibility(normal_world, tangent_world.xyz, visibility)
    ambient_visibility = visibility;
#endif
    gl_Position = clip_from_world * world;
}
