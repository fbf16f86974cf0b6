// Grain of film over display values. Twin: rig/camera/film_grain.cpp.
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) uniform float strength;
layout(location = 1) uniform float size_pixels;
layout(location = 2) uniform uint time;  // of the frame and the seed
layout(location = 0) out vec4 result;

// PCG of three words (Jarzynski and Olano 2020, pcg3d).
uvec2 hash(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    return v.xy;
}

// Sum of two uniform values, scaled to variance 1.
float lattice(ivec2 at) {
    vec2 uniforms = vec2(hash(uvec3(uvec2(at), time)) >> 16u) / 65536.0;
    return (uniforms.x + uniforms.y - 1.0 + 1.0 / 65536.0) * sqrt(6.0);
}

float noise(ivec2 at) {
    if (!(size_pixels > 1.0)) return lattice(at);
    vec2 place = vec2(at) / size_pixels;
    ivec2 low = ivec2(floor(place));
    vec2 f = place - floor(place);
    vec4 weights = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
    vec4 values = vec4(lattice(low), lattice(low + ivec2(1, 0)), lattice(low + ivec2(0, 1)), lattice(low + 1));
    return dot(weights, values) * inversesqrt(dot(weights, weights));
}

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec4 color = texelFetch(picture, here, 0);
    vec3 value = clamp(color.rgb, 0.0, 1.0);
    float reach = sqrt(6.0) * (size_pixels > 1.0 ? 2.0 : 1.0);
    vec3 deviation = min(2.0 * strength * sqrt(value * (1.0 - value)), min(value, 1.0 - value) / reach);
    result = vec4(value + deviation * noise(here), color.a);
}
