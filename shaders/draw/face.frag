// Linear HDR shading of the face, drawn forward: interpolants fill a surface's record, the record is lit.
#include "draw/shading.glsl"
#include "draw/coverage.glsl"

// At the centroid of the samples that are covered: the middle of a pixel may lie beyond a triangle's edge, and where that
// is seen from its side, far beyond what the surface has there.
centroid in vec3 position_world;
centroid in vec3 normal_world;
centroid in vec4 tangent_world;
centroid in vec2 texture_uv[6];
centroid in vec2 layout_uv;
#ifdef CALLS_VISIBILITY
centroid in vec4 ambient_visibility;
#endif

// The largest finite half float is 65504; a highlight beyond this would be infinite in the scene colour.
const float largest_radiance = 60000.0;

layout(location = 0) out vec4 radiance_linear;
#insert output_effects

Uv with_derivatives(vec2 uv) { return Uv(uv, dFdx(uv), dFdy(uv)); }

Interpolants interpolants() {
    Interpolants at;
    at.position_world = position_world;
    at.position_dx = dFdx(position_world);
    at.position_dy = dFdy(position_world);
    at.normal_world = normal_world;
    at.tangent_world = tangent_world;
    at.ambient_visibility = vec4(1.0);
#ifdef CALLS_VISIBILITY
    at.ambient_visibility = ambient_visibility;
#endif
    at.layout_uv = with_derivatives(layout_uv);
    for (int t = 0; t < 6; ++t) at.texture_uv[t] = with_derivatives(texture_uv[t]);
    at.front_facing = gl_FrontFacing;
    return at;
}

void main() {
    Surface s = model_surface(interpolants());
    float opacity = covered(s.opacity);
    Lighting lit = model_lighting(s);
    vec3 inside = light_from_inside(s, lit);
    // What an effect writes to targets of its own it takes from here.
#call output(s, lit, opacity, inside)
    radiance_linear = vec4(min(lit.reflected + inside, vec3(largest_radiance)), opacity);
}
