// What of a pixel's light blooms. Twin: rig/camera/bloom.cpp.

// Radiance that is not a number counts as 0; the most is what face.frag limits itself to.
vec3 usable(vec3 c) {
    return mix(vec3(0.0), min(c, vec3(60000.0)), greaterThan(c, vec3(0.0)));
}

vec3 bright(vec3 c, float threshold) {
    float largest = max(max(c.r, c.g), c.b);
    return largest > threshold ? c * ((largest - threshold) / largest) : vec3(0.0);
}
