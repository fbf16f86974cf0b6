// A level of the pyramid and what is below it, enlarged.
#include "camera/bloom_enlarge.glsl"

layout(binding = 0) uniform sampler2D level;
layout(binding = 1) uniform sampler2D below;
layout(location = 0) uniform float share;  // of this level
layout(location = 0) out vec4 result;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec3 spread = enlarged(below, here);
    result = vec4(spread + share * (texelFetch(level, here, 0).rgb - spread), 1.0);
}
