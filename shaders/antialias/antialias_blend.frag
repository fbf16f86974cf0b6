// Third pass of MLAA and SMAA (jimenez-2012, 9.5): each texel takes from its neighbours what the weights say; the same
// as rig/antialias/blend.cpp. DECODE_SRGB: the colours are sRGB and are mixed as light. STRAIGHT_ALPHA: they are not
// multiplied by their coverage yet.
#include "shared.glsl"

layout(binding = BLUSH_AA_COLOR_UNIT) uniform sampler2D color;
layout(binding = BLUSH_AA_WEIGHTS_UNIT) uniform sampler2D weights;
layout(location = 0) out vec4 blended;

// IEC 61966-2-1, odd beyond 0 so that it can be undone. (The larger of 1e-30 keeps pow() from 0.)
vec3 linear_from_srgb(vec3 c) {
    vec3 a = abs(c);
    return sign(c) * mix(a / 12.92, pow((a + 0.055) / 1.055, vec3(2.4)), greaterThan(a, vec3(0.04045)));
}
vec3 srgb_from_linear(vec3 c) {
    vec3 a = abs(c);
    vec3 curved = 1.055 * pow(max(a, vec3(1e-30)), vec3(1.0 / 2.4)) - 0.055;
    return sign(c) * mix(12.92 * a, curved, greaterThan(a, vec3(0.0031308)));
}

float finite(float x) { return isnan(x) ? 0.0 : isinf(x) ? (x > 0.0 ? 65504.0 : -65504.0) : x; }
vec4 texel_at(ivec2 p) { return texelFetch(color, clamp(p, ivec2(0), textureSize(color, 0) - 1), 0); }
vec4 weights_at(ivec2 p) {
    return all(lessThan(p, textureSize(weights, 0))) ? texelFetch(weights, p, 0) : vec4(0.0);
}

vec4 light_of(vec4 c) {
    c = vec4(finite(c.r), finite(c.g), finite(c.b), finite(c.a));
#ifdef DECODE_SRGB
    c.rgb = linear_from_srgb(c.rgb);
#endif
#ifdef STRAIGHT_ALPHA
    c.rgb *= c.a;
#endif
    return c;
}
vec4 texel_of(vec4 c) {
#ifdef STRAIGHT_ALPHA
    c.rgb = c.a != 0.0 ? c.rgb / c.a : vec3(0.0);
#endif
#ifdef DECODE_SRGB
    c.rgb = srgb_from_linear(c.rgb);
#endif
    return c;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 own = texelFetch(weights, p, 0);
    vec4 w = vec4(own.r, own.b, weights_at(p + ivec2(0, 1)).g, weights_at(p + ivec2(1, 0)).a);  // up, left, down, right
    vec4 texel = texel_at(p);
    float sum = w.x + w.y + w.z + w.w;
    if (sum == 0.0) {
        blended = texel;
        return;
    }
    // (9.1) for each neighbour; a pixel of several lines takes their mean, weighted by their areas (listing 9.5).
    vec4 here = light_of(texel);
    vec4 mixed = w.x / sum * mix(here, light_of(texel_at(p - ivec2(0, 1))), w.x) +
                 w.y / sum * mix(here, light_of(texel_at(p - ivec2(1, 0))), w.y) +
                 w.z / sum * mix(here, light_of(texel_at(p + ivec2(0, 1))), w.z) +
                 w.w / sum * mix(here, light_of(texel_at(p + ivec2(1, 0))), w.w);
    blended = texel_of(mixed);
}
