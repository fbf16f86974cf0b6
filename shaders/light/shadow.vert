// Depth of the surface as a light sees it. BASE_COLOR_MAP: with the texture coordinates by which hair is cut out.
#include "shared.glsl"

layout(location = BLUSH_POSITION_ATTRIBUTE) in vec3 position;
layout(location = 0) uniform mat4 shadow_from_mesh;  // composed in double precision

#ifdef BASE_COLOR_MAP
layout(location = BLUSH_UV0_ATTRIBUTE) in vec2 uv0;
layout(location = BLUSH_UV1_ATTRIBUTE) in vec2 uv1;
out vec2 texture_uv[6];  // as of face.vert; the base colour's is the first
#endif

void main() {
    gl_Position = shadow_from_mesh * vec4(position, 1.0);
#ifdef BASE_COLOR_MAP
    vec3 uv = vec3(uv_sets[0] == 1 ? uv1 : uv0, 1.0);
    for (int i = 0; i < 6; ++i) texture_uv[i] = vec2(dot(uv_rows[0].xyz, uv), dot(uv_rows[1].xyz, uv));
#endif
}
