// Share of the 3 x 3 texels around a place of a depth map (texels) that lie beyond `here`, those on the rim in part: four
// gathers. `reversed`: near is 1.
float share_beyond(sampler2D map, vec2 middle, float here, bool reversed) {
    vec2 at = middle - 0.5;
    vec2 part = fract(at);
    vec2 texel_uv = 1.0 / vec2(textureSize(map, 0));
    vec2 corner = floor(at);
    vec4 weight_x = vec4(1.0 - part.x, 1.0, 1.0, part.x), weight_y = vec4(1.0 - part.y, 1.0, 1.0, part.y);
    float sum = 0.0;
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 2; ++x) {
            // Order of a gather: (0, 1), (1, 1), (1, 0), (0, 0).
            vec4 depth = textureGather(map, (corner + vec2(2 * x, 2 * y)) * texel_uv);
            vec4 lit = reversed ? step(depth, vec4(here)) : step(vec4(here), depth);
            vec2 wx = x == 0 ? weight_x.xy : weight_x.zw, wy = y == 0 ? weight_y.xy : weight_y.zw;
            sum += wy.y * (wx.x * lit.x + wx.y * lit.y) + wy.x * (wx.y * lit.z + wx.x * lit.w);
        }
    }
    return sum / 9.0;
}
