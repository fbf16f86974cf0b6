// Appearance laid out flat: the wrinkled normal, or the colour that blood gives to white, over the texture. What studies
// and tests compare with the CPU.
#include "shared.glsl"
#insert uniforms
#include "vectors.glsl"
#include "draw/interpolants.glsl"
#include "draw/relief.glsl"
#insert effects

in vec2 screen_uv;
layout(location = 0) out vec4 result;

void main() {
    Interpolants at;
    at.layout_uv = Uv(screen_uv, dFdx(screen_uv), dFdy(screen_uv));
    Relief relief = Relief(vec3(0.0, 0.0, 1.0), false);
    vec3 color = vec3(1.0);
#call relief(at, relief)
#call colour(at, color)
#ifdef CALLS_RELIEF
    color = normalize(relief.normal);
#endif
    result = vec4(color, 1.0);
}
