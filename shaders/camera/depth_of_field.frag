// Gathers what the circles of confusion of the pixels around cover: one layer of what is in or behind the focus, and one
// of what is in front of it, over the first (after Jimenez 2014, and rig/camera/depth_of_field.cpp, its twin).
#include "shared.glsl"

layout(binding = 0) uniform sampler2D scene_color;
layout(binding = 1) uniform sampler2D radius_pixels;
layout(binding = 2) uniform sampler2D in_front;  // largest radius of each tile
layout(location = 0) uniform int tile_pixels;
layout(location = 1) uniform int tap_count;
layout(location = 2) uniform vec2 taps[BLUSH_MOST_BLUR_TAPS];
layout(location = 0) out vec4 result;

const float pi = 3.14159265358979;
const float sharp_radius = 0.5;

float covered(float radius, float distance) { return clamp(radius - distance + 0.5, 0.0, 1.0); }
float area(float radius) { return max(pi * radius * radius, 1.0); }

float usable(float v) { return v > 0.0 ? min(v, 60000.0) : 0.0; }

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(scene_color, 0) - 1;
    float own = texelFetch(radius_pixels, here, 0).r;
    float reach = abs(own);
    ivec2 tile = here / tile_pixels, last_tile = textureSize(in_front, 0) - 1;
    for (int y = max(tile.y - 1, 0); y <= min(tile.y + 1, last_tile.y); ++y) {
        for (int x = max(tile.x - 1, 0); x <= min(tile.x + 1, last_tile.x); ++x) {
            reach = max(reach, texelFetch(in_front, ivec2(x, y), 0).r);
        }
    }
    vec4 centre = texelFetch(scene_color, here, 0);
    if (reach < 0.5) {
        result = centre;
        return;
    }
    float tap_area = pi * reach * reach / float(tap_count);
    bool blurred_in_front = own < -sharp_radius;
    vec4 near = vec4(0.0), far = vec4(0.0);  // rgb: sum of colour times weight, a: of the weights
    for (int i = 0; i < tap_count; ++i) {
        precise vec2 place = taps[i] * reach + 0.5;
        ivec2 offset = ivec2(floor(place));
        ivec2 at = clamp(here + offset, ivec2(0), last);
        float radius = texelFetch(radius_pixels, at, 0).r;
        vec3 c = texelFetch(scene_color, at, 0).rgb;
        vec4 color = vec4(usable(c.r), usable(c.g), usable(c.b), 1.0);
        float distance = length(vec2(offset));
        if (radius < -sharp_radius) {
            near += covered(-radius, distance) * tap_area / area(radius) * color;
        } else {
            // Behind this pixel: no further than its own circle. Behind what is in front of the focus: a filling.
            float circle = min(max(radius, 0.0), max(own, 0.0));
            far += (blurred_in_front ? 1.0 : covered(circle, distance) / area(circle)) * color;
        }
    }
    vec3 behind = far.a > 0.0 ? far.rgb / far.a : near.rgb / max(near.a, 1e-9);
    vec3 front = near.a > 0.0 ? near.rgb / near.a : behind;
    result = vec4(mix(behind, front, min(near.a, 1.0)), centre.a);
}
