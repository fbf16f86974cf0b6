// Interpolants as the rasteriser has them, of face.vert.

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
