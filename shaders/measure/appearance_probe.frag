// Appearance laid out flat: the wrinkled normal, or the colour that blood gives to white, over the texture. What studies
// and tests compare with the CPU.
#include "shared.glsl"
#ifdef WRINKLES
#include "wrinkles/wrinkles.glsl"
#endif
#ifdef BLOOD
#include "blood/blood.glsl"
#endif

in vec2 screen_uv;
layout(location = 0) out vec4 result;

void main() {
    result = vec4(1.0);
#ifdef WRINKLES
    vec2 uv = wrinkle_uv(screen_uv);
    result = vec4(normalize(wrinkled(vec3(0.0, 0.0, 1.0), uv, wrinkle_strength(uv))), 1.0);
#endif
#ifdef BLOOD
    result = vec4(flushed(vec3(1.0), screen_uv), 1.0);
#endif
}
