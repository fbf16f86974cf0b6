// From linear radiance, premultiplied with opacity, to display values that are premultiplied too: exposure, the filmic curve and the sRGB transfer function.
#include "shared.glsl"
#include "srgb.glsl"

in vec2 screen_uv;
layout(binding = BLUSH_SCENE_COLOR_UNIT) uniform sampler2D scene_color;
layout(binding = 1) uniform sampler2D log2_metered;  // one texel: log2 of the automatic exposure
layout(location = 0) uniform float exposure;
layout(location = 1) uniform bool metered;
layout(location = 0) out vec4 display_srgb;

// Filmic curve of Hable (2010), as jimenez-2012, 8.3, uses it: shoulder 0.15, linear strength 0.50, linear angle 0.10,
// toe strength 0.20, toe numerator 0.02, toe denominator 0.30.
vec3 filmic(vec3 x) {
    return (x * (0.15 * x + 0.10 * 0.50) + 0.20 * 0.02) / (x * (0.15 * x + 0.50) + 0.20 * 0.30) - 0.02 / 0.30;
}
// Scene radiance that the curve maps to white (Hable 2010).
const float white = 11.2;
// Hable's exposure bias: the curve is darker than linear by about this in the middle greys.
const float exposure_bias = 2.0;

void main() {
    vec4 scene = texelFetch(scene_color, ivec2(gl_FragCoord.xy), 0);
    // The curve is for colours as they are seen, not as they are weighed. What has no opacity adds its light.
    bool translucent = scene.a > 0.0 && scene.a < 1.0;
    if (translucent) scene.rgb /= scene.a;
    float factor = exposure_bias * exposure;
    if (metered) factor *= exp2(texelFetch(log2_metered, ivec2(0), 0).r);
    // What is not a number becomes black; the curve rises to its end far beyond what is white.
    vec3 radiance = mix(vec3(0.0), min(factor * scene.rgb, vec3(1e6)), greaterThan(scene.rgb, vec3(0.0)));
    vec3 mapped = filmic(radiance) / filmic(vec3(white));
    display_srgb = vec4(srgb_from_linear(mapped) * (translucent ? scene.a : 1.0), scene.a);
}
