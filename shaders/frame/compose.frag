// A finished picture into its rectangle of the host's framebuffer, premultiplied with its opacity.
#include "shared.glsl"
#include "srgb.glsl"

layout(binding = BLUSH_SCENE_COLOR_UNIT) uniform sampler2D picture;
layout(location = 0) uniform ivec2 corner;  // of the rectangle, pixels
layout(location = 1) uniform bool decoded;  // of display values that the texture unit decodes: a kept picture
layout(location = 0) out vec4 color;

void main() {
    color = texelFetch(picture, ivec2(gl_FragCoord.xy) - corner, 0);
    if (decoded) color.rgb = srgb_from_linear(color.rgb);
}
