// Linear HDR shading of the face, drawn forward: interpolants fill a surface's record, the record is lit.
#include "draw/shading.glsl"
#include "draw/coverage.glsl"
#include "draw/rasterised.glsl"

// The largest finite half float is 65504; a highlight beyond this would be infinite in the scene colour.
const float largest_radiance = 60000.0;

layout(location = 0) out vec4 radiance_linear;
#insert output_effects

void main() {
    Surface s = model_surface(interpolants());
    float opacity = covered(s.opacity);
    Lighting lit = model_lighting(s);
    vec3 inside = light_from_inside(s, lit);
    // What an effect writes to targets of its own it takes from here.
#call output(s, lit, opacity, inside)
    radiance_linear = vec4(min(lit.reflected + inside, vec3(largest_radiance)), opacity);
}
