// From the cells' sums to the log2 of the exposure, adapted from the last one. Twin: rig/camera/exposure.cpp.
#include "shared.glsl"

layout(binding = 0) uniform sampler2D cells;
layout(binding = 1) uniform sampler2D before;  // log2 of the last exposure
layout(location = 0) uniform vec3 key_stops_range;
layout(location = 1) uniform vec3 seconds_half_lives;  // since the last frame (below 0: at once), darker, brighter
layout(location = 0) out vec4 log2_exposure;

void main() {
    vec2 total = vec2(0.0);
    for (int y = 0; y < BLUSH_EXPOSURE_CELLS; ++y) {
        vec2 row = vec2(0.0);
        for (int x = 0; x < BLUSH_EXPOSURE_CELLS; ++x) row += texelFetch(cells, ivec2(x, y), 0).rg;
        total += row;
    }
    float average = total.y > 0.0 ? total.x / total.y : log2(1e-4);
    float range = key_stops_range.z;
    float target = clamp(log2(key_stops_range.x) - average + key_stops_range.y, -range, range);
    if (seconds_half_lives.x >= 0.0) {
        float last = texelFetch(before, ivec2(0), 0).r;
        float half_life = target < last ? seconds_half_lives.y : seconds_half_lives.z;
        target = last + (target - last) * (1.0 - exp2(-seconds_half_lives.x / half_life));
    }
    log2_exposure = vec4(target, 0.0, 0.0, 1.0);
}
