// Where each point of the surface is on the screen, and where it was in the last frame.
#include "shared.glsl"

layout(location = BLUSH_POSITION_ATTRIBUTE) in vec3 position;
layout(location = BLUSH_LAST_POSITION_ATTRIBUTE) in vec3 last_position;
layout(location = BLUSH_UV0_ATTRIBUTE) in vec2 uv0;
layout(location = BLUSH_UV1_ATTRIBUTE) in vec2 uv1;

// Composed in double precision.
layout(location = 0) uniform mat4 sampled_clip_from_mesh;  // moved to where this picture is sampled
layout(location = 1) uniform mat4 clip_from_mesh;          // not moved: what stands still has no velocity
layout(location = 2) uniform mat4 last_clip_from_mesh;

out vec4 clip;
out vec4 last_clip;
#ifdef ALPHA_TEST
out vec2 base_color_uv;
#endif

void main() {
    clip = clip_from_mesh * vec4(position, 1.0);
    last_clip = last_clip_from_mesh * vec4(last_position, 1.0);
#ifdef ALPHA_TEST
    vec3 uv = vec3(uv_sets.x == 1 ? uv1 : uv0, 1.0);
    base_color_uv = vec2(dot(uv_rows[0].xyz, uv), dot(uv_rows[1].xyz, uv));
#endif
    gl_Position = sampled_clip_from_mesh * vec4(position, 1.0);
}
