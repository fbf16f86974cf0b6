// Appearance laid out flat: the wrinkled normal, or the colour that blood gives to white, over the texture. What studies
// and tests compare with the CPU.
#include "shared.glsl"
#include "vectors.glsl"
#include "draw/interpolants.glsl"
#include "draw/relief.glsl"
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
    Interpolants at;
    at.layout_uv = Uv(screen_uv, dFdx(screen_uv), dFdy(screen_uv));
#ifdef WRINKLES
    Relief relief = Relief(vec3(0.0, 0.0, 1.0), false);
    wrinkles_relief(at, relief);
    result = vec4(normalize(relief.normal), 1.0);
#endif
#ifdef BLOOD
    blood_colour(at, result.rgb);
#endif
}
