// The blend of the expressions' scales and offsets (jimenez-2012, 7.6, in the form of rig/blood/hemoglobin.h), once for a pose
// and not once for a pixel.
#include "shared.glsl"

layout(binding = BLUSH_SCENE_COLOR_UNIT) uniform sampler2DArray changes;  // a layer a map: scale and offset
layout(location = 0) uniform int share_count;
layout(location = 1) uniform ivec4 layers[BLUSH_MOST_BLOOD_MAPS / 4];
layout(location = 1 + BLUSH_MOST_BLOOD_MAPS / 4) uniform vec4 shares[BLUSH_MOST_BLOOD_MAPS / 4];

layout(location = 0) out vec4 change;

void main() {
    vec2 sum = vec2(1.0, 0.0);
    for (int i = 0; i < share_count; ++i) {
        vec2 of_map = texelFetch(changes, ivec3(ivec2(gl_FragCoord.xy), layers[i / 4][i % 4]), 0).xy;
        sum += shares[i / 4][i % 4] * (of_map - vec2(1.0, 0.0));
    }
    change = vec4(sum, 0.0, 1.0);
}
