// The scene with the share `strength` of its bright light spread.
#include "camera/bloom_enlarge.glsl"
#include "camera/bloom_light.glsl"

layout(binding = 0) uniform sampler2D scene_color;
layout(binding = 1) uniform sampler2D spread;
layout(location = 0) uniform float strength;
layout(location = 1) uniform float threshold;
layout(location = 0) out vec4 result;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec4 scene = texelFetch(scene_color, here, 0);
    vec3 c = usable(scene.rgb);
    result = vec4(max(c + strength * (enlarged(spread, here) - bright(c, threshold)), vec3(0.0)), scene.a);
}
