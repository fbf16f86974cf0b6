// Velocity of a pixel in widths and heights of the picture a frame: how far its surface moved since the last frame.
#include "shared.glsl"

in vec4 clip;
in vec4 last_clip;
#ifdef ALPHA_TEST
in vec2 base_color_uv;
layout(binding = BASE_COLOR_MAP) uniform sampler2D base_color_map;
#endif

// Length, x, y; and how far before the far plane the surface was in the last frame: 1 - window depth, which half floats
// tell apart as finely far away as near. 0: nothing is drawn here.
layout(location = 0) out vec4 speed_velocity;

void main() {
#ifdef ALPHA_TEST
    // Blended hair moves where it is opaque.
    float cutoff = alpha.y == 0.0 ? BLUSH_HAIR_CORE_OPACITY : alpha.x;
    if (base_color_linear.a * texture(base_color_map, base_color_uv).a < cutoff) discard;
#endif
    // What was behind the camera was not on the screen: as far away as a velocity can say, four screens. The clamp keeps
    // half floats finite.
    vec2 velocity = vec2(4.0);
    float before_far = 0.0;
    if (last_clip.w > 1e-6 && clip.w > 1e-6) {
        velocity = clamp(0.5 * (clip.xy / clip.w - last_clip.xy / last_clip.w), vec2(-4.0), vec2(4.0));
        before_far = clamp(0.5 * (last_clip.w - last_clip.z) / last_clip.w, 0.0, 1.0);
    }
    speed_velocity = vec4(length(velocity), velocity, before_far);
}
