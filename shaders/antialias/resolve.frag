// Averages the samples of a pixel with weights that fall with the radiance, so that one burning sample does not drown the
// others of an edge: w = 1 / (1 + exposure * largest channel), the weights with which the curve x / (1 + x) is applied to
// every sample and taken back from the mean (Karis 2013, after Persson 2008; the thesis
// of 2012 resolves display values and has no rule of its own). The largest channel, and not luma: a saturated highlight
// burns as a white one does. All images of a scene are averaged with the weights of the scene's colour.
#include "shared.glsl"

layout(binding = 0) uniform sampler2DMS scene_color;
layout(binding = 1) uniform sampler2DMS image;
layout(location = 0) uniform float exposure;
layout(location = 0) out vec4 resolved;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    int samples = textureSamples(image);
    for (int i = 0; i < samples; ++i) {
        vec3 c = texelFetch(scene_color, pixel, i).rgb;
        float weight = 1.0 / (1.0 + exposure * max(max(c.r, c.g), max(c.b, 0.0)));
        sum += weight * texelFetch(image, pixel, i);
        weights += weight;
    }
    resolved = sum / weights;
}
