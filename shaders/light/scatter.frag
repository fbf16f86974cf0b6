// Diffusion of the skin's light in screen space: separable (jimenez-2012, chapter 6), by Gaussians (chapter 4) or by
// jittered taps (4.2). Twin: rig/light/scatter_image.cpp. The light is multiplied with the skin's matte: a pixel without skin
// is all zero, so nothing else can bleed in. All sums are differences to the centre, so that constant light keeps its
// bits. Permutations: TAPS (separable: number of taps; across and down), GAUSSIAN, JITTERED; COMPOSITE: the result is
// multiplied with the albedo and added to the scene; MANY: several characters, each with a kernel of its own, whose light
// does not mix.
#include "shared.glsl"

layout(binding = BLUSH_SKIN_LIGHT_UNIT) uniform sampler2D skin_light;  // rgb times matte, matte
layout(binding = BLUSH_SKIN_DEPTH_UNIT) uniform sampler2D skin_depth;  // mm; the number of the character; times matte
layout(binding = BLUSH_SKIN_ALBEDO_UNIT) uniform sampler2D skin_albedo;  // rgb and strength, times matte

layout(location = 0) uniform vec2 scale_pixels;       // pixels a millimetre at a depth of 1 mm, or anywhere
layout(location = 1) uniform float perspective;       // 1: perspective, 0: orthographic
layout(location = 2) uniform float follow_mm;         // 0: do not look at depth
layout(location = 3) uniform vec2 direction;          // (1, 0) or (0, 1)
layout(location = 4) uniform vec4 gaussian;           // sigma of this step, sigma of the Gaussian, mm; beta, gamma (4.1)
layout(location = 5) uniform float gaussian_weights[4];  // of the centre and the taps at 1, 2 and 3 sigma
layout(location = 9) uniform vec4 middle_ring;        // rgb: weight of a tap; w: radius, mm
layout(location = 10) uniform vec4 wide_ring;
layout(location = 11) uniform vec4 taps[BLUSH_MOST_KERNEL_TAPS];  // rgb: weight; w: offset, mm. The centre is left out.

#ifdef MANY
layout(location = 43) uniform int only_profile;  // characters of this profile alone; -1: all
layout(std430, binding = BLUSH_SCATTER_BINDING) readonly buffer ScatterTable {
    vec4 of_character[BLUSH_MOST_SCATTERING];  // x: its first tap; y: follow_mm; z: factor on scale_pixels; w: its profile
    vec4 kernels[];                            // as taps
};
#endif

layout(location = 0) out vec4 result;

const float pi = 3.14159265358979;

// Of light that goes as far as the strength map lets it.
vec2 pixels_a_mm(float depth_mm, float strength, float factor) {
    return strength * min(factor * scale_pixels / max(depth_mm * perspective + 1.0 - perspective, 1e-9), vec2(BLUSH_MOST_PIXELS_A_MM));
}

#ifdef MANY
// Of the number of another character, which filtering and resolving samples have mixed in: half floats keep the matte to
// a 2048th.
bool is_other(float number, float here) { return abs(number - here) > 0.002 + 0.001 * here; }
#endif

// What a tap adds to the centre's colour, for a weight of 1.
vec3 difference(vec2 place, vec2 texel, vec3 centre, vec2 skin, float follow_mm) {
    vec2 uv = place * texel;
    vec4 light = texture(skin_light, uv);
    vec3 d = light.rgb - centre * light.a;
#ifdef MANY
    if (light.a > 0.0 && is_other(texture(skin_depth, uv).g / light.a, skin.g)) return vec3(0.0);
#endif
#ifndef GAUSSIAN
    if (follow_mm > 0.0 && light.a > 0.0) {
        float apart = abs(texture(skin_depth, uv).r / light.a - skin.r) / follow_mm;
        d *= 1.0 - min(apart, 1.0);
    }
#endif
    return d;
}

#ifdef GAUSSIAN
float gradient_mm(ivec2 here, float depth_mm) {
    ivec2 next = here + ivec2(direction);
    if (any(greaterThanEqual(next, textureSize(skin_light, 0)))) return 0.0;
    float matte = texelFetch(skin_light, next, 0).a;
    return matte > 0.0 ? texelFetch(skin_depth, next, 0).r / matte - depth_mm : 0.0;
}
#endif

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec4 light = texelFetch(skin_light, here, 0);
    if (!(light.a > 0.0)) discard;
    vec3 centre = light.rgb / light.a;
    vec2 skin = texelFetch(skin_depth, here, 0).rg / light.a;
    float depth_mm = skin.r;
#ifdef MANY
    vec4 own = of_character[int(skin.g + 0.5) % BLUSH_MOST_SCATTERING];
    if (only_profile >= 0 && int(own.w) != only_profile) discard;
    float follow_mm = own.y, factor = own.z;
#else
    const float factor = 1.0;
#endif
    vec2 texel = 1.0 / vec2(textureSize(skin_light, 0));
    vec3 sum = centre;
    vec4 albedo = texelFetch(skin_albedo, here, 0);
    float strength = albedo.a / light.a;

#if defined(TAPS)
    vec2 step_pixels = direction * pixels_a_mm(depth_mm, strength, factor);
    for (int i = 0; i < TAPS - 1; ++i) {
#ifdef MANY
        vec4 tap = kernels[int(own.x) + i];
#else
        vec4 tap = taps[i];
#endif
        sum += tap.rgb * difference(gl_FragCoord.xy + tap.w * step_pixels, texel, centre, skin, follow_mm);
    }
#elif defined(GAUSSIAN)
    if (gaussian.y * pixels_a_mm(depth_mm, strength, factor).y > 0.5) {  // eq. 4.5
        float slope = gaussian.z * min(abs(gradient_mm(here, depth_mm)), gaussian.w);
        vec2 step_pixels = direction * pixels_a_mm(depth_mm + perspective * slope, strength, factor) * gaussian.x;
        for (int k = 1; k <= 3; ++k) {
            sum += gaussian_weights[k] *
                   (difference(gl_FragCoord.xy - float(k) * step_pixels, texel, centre, skin, follow_mm) +
                    difference(gl_FragCoord.xy + float(k) * step_pixels, texel, centre, skin, follow_mm));
        }
    }
#elif defined(JITTERED)
    const float pattern[16] =
        float[16](0.0, 8.0, 2.0, 10.0, 12.0, 4.0, 14.0, 6.0, 3.0, 11.0, 1.0, 9.0, 15.0, 7.0, 13.0, 5.0);
    float turn = pattern[(here.y & 3) * 4 + (here.x & 3)] / 16.0 * (pi / 3.0);
    vec2 scale = pixels_a_mm(depth_mm, strength, factor);
    for (int k = 0; k < 12; ++k) {
        vec4 ring = k < 6 ? middle_ring : wide_ring;
        float angle = turn + (float(k % 6) + (k < 6 ? 0.0 : 0.5)) * (pi / 3.0);
        vec2 place = gl_FragCoord.xy + ring.w * scale * vec2(cos(angle), sin(angle));
        sum += ring.rgb * difference(place, texel, centre, skin, follow_mm);
    }
#endif

#ifdef COMPOSITE
    result = vec4(max(sum, vec3(0.0)) * albedo.rgb, 0.0);
#else
    result = vec4(sum * light.a, light.a);
#endif
}
