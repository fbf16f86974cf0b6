// Half the sides: the mean of 2x2 texels. FIRST: of the light that blooms.
layout(binding = 0) uniform sampler2D image;
#ifdef FIRST
layout(location = 0) uniform float threshold;
#include "camera/bloom_light.glsl"
#endif
layout(location = 0) out vec4 result;

vec3 fetch(ivec2 at) {
    vec3 c = texelFetch(image, at, 0).rgb;
#ifdef FIRST
    c = bright(usable(c), threshold);
#endif
    return c;
}

void main() {
    ivec2 low = 2 * ivec2(gl_FragCoord.xy), high = min(low + 1, textureSize(image, 0) - 1);
    // Each quarter before the sum: four times the largest half float is none.
    result = vec4(0.25 * fetch(low) + 0.25 * fetch(ivec2(high.x, low.y)) + 0.25 * fetch(ivec2(low.x, high.y)) +
                      0.25 * fetch(high),
                  1.0);
}
