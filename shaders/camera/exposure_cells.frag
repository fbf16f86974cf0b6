// Log2 luminance of each cell of the picture, its sum and the sum of the weights. Twin: rig/camera/exposure.cpp.
#include "shared.glsl"

layout(binding = BLUSH_SCENE_COLOR_UNIT) uniform sampler2D scene_color;
layout(location = 0) uniform bool centre;
layout(location = 0) out vec4 sums;

void main() {
    ivec2 size = textureSize(scene_color, 0);
    ivec2 cell = ivec2(gl_FragCoord.xy);
    ivec2 first = cell * size / BLUSH_EXPOSURE_CELLS, end = (cell + 1) * size / BLUSH_EXPOSURE_CELLS;
    float sum = 0.0, weights = 0.0;
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            vec3 c = texelFetch(scene_color, ivec2(x, y), 0).rgb;
            float total = c.r + c.g + c.b;
            if (isnan(total) || isinf(total)) continue;
            float weight = 1.0;
            if (centre) {
                vec2 from_middle = (vec2(x, y) + 0.5 - 0.5 * vec2(size)) / float(size.y);
                weight = max(exp(-dot(from_middle, from_middle) / (2.0 * 0.2 * 0.2)), 1e-3);
            }
            sum += weight * log2(dot(max(c, vec3(0.0)), vec3(0.2126, 0.7152, 0.0722)) + 1e-4);
            weights += weight;
        }
    }
    sums = vec4(sum, weights, 0.0, 1.0);
}
