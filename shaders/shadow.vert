// Depth of the surface as a light sees it.
#include "shared.glsl"

layout(location = BLUSH_POSITION_ATTRIBUTE) in vec3 position;
layout(location = 0) uniform mat4 shadow_from_world;

void main() { gl_Position = shadow_from_world * (world_from_mesh * vec4(position, 1.0)); }
