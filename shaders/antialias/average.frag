// The mean of the pictures of a frame, in linear light: that of a display where the pictures are display values.
#include "srgb.glsl"

layout(binding = 0) uniform sampler2D mean_so_far;
layout(binding = 1) uniform sampler2D picture;
layout(location = 0) uniform float share;  // of `picture`: 1 / number of pictures so far
layout(location = 1) uniform bvec2 encoded;  // sRGB: picture, result; mean_so_far is decoded by its texture
layout(location = 0) out vec4 result;

vec4 fetch(sampler2D image, bool decode) {
    vec4 color = texelFetch(image, ivec2(gl_FragCoord.xy), 0);
    return decode ? vec4(linear_from_srgb(color.rgb), color.a) : color;
}

void main() {
    // Not mix(): a mean of two must not depend on their order, so that a still frame is the same in both phases.
    vec4 mean = (1.0 - share) * fetch(mean_so_far, false) + share * fetch(picture, encoded.x);
    result = encoded.y ? vec4(srgb_from_linear(mean.rgb), mean.a) : mean;
}
