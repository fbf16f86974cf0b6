// Light from all around after the face itself has hidden a part of it: occlusion.glsl has computed it for the vertices.

void occlusion_ambient(Surface s, vec3 mirror, inout Ambient around) {
    // What a vertex's own normal loses, its pixels lose, whatever their normals: the detail of maps stays.
    vec4 visible = clamp(s.visibility, 0.0, 1.0);
    around.white *= visible.rgb;
    // What hides a place shines as it does itself: with_bounces() in rig/light/occlusion.cpp.
    if (occlusion.bounces != 0) {
        around.white /= max(1.0 - min(diffuse_color(s), vec3(1.0)) * (1.0 - visible.a), vec3(1e-3));
    }
    around.mirrored *= visible.a;
}
