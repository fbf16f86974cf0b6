// Radius of each pixel's circle of confusion, pixels; below 0 in front of the focus. Twin: rig/camera/depth_of_field.cpp.
// MULTISAMPLED: of the nearest sample, so that no pixel of an edge spreads what stands in front.
layout(location = 0) uniform vec3 blur;        // scale, focus in mm, largest
layout(location = 1) uniform vec3 projection;  // clip_from_view[2][2], [3][2], millimetres a unit
#ifdef MULTISAMPLED
layout(binding = 0) uniform sampler2DMS scene_depth;
#else
layout(binding = 0) uniform sampler2D scene_depth;
#endif
layout(location = 0) out vec4 radius_pixels;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
#ifdef MULTISAMPLED
    float depth = 1.0;
    for (int i = 0; i < textureSamples(scene_depth); ++i) depth = min(depth, texelFetch(scene_depth, here, i).r);
#else
    float depth = texelFetch(scene_depth, here, 0).r;
#endif
    // What nothing was drawn on is infinitely far.
    float nearness = 0.0;
    if (depth < 1.0) nearness = (2.0 * depth - 1.0 + projection.x) / (projection.y * projection.z);
    float radius = blur.x * (1.0 - blur.y * nearness);
    radius_pixels = vec4(clamp(radius, -blur.z, blur.z), 0.0, 0.0, 1.0);
}
