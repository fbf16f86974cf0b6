// A value of an image of twice the sides: nearest texel 3/4, the next one 1/4, in either direction. Nested mixes keep a
// constant to the bit.
vec3 enlarged(sampler2D image, ivec2 at) {
    ivec2 near = at / 2;
    ivec2 next = clamp(near + 2 * (at & 1) - 1, ivec2(0), textureSize(image, 0) - 1);
    vec3 a = texelFetch(image, near, 0).rgb, b = texelFetch(image, ivec2(next.x, near.y), 0).rgb;
    vec3 c = texelFetch(image, ivec2(near.x, next.y), 0).rgb, d = texelFetch(image, next, 0).rgb;
    vec3 low = a + 0.25 * (b - a), high = c + 0.25 * (d - c);
    return low + 0.25 * (high - low);
}
