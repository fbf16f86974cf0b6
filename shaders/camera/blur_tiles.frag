// The largest circle in front of the focus in each tile.
layout(binding = 0) uniform sampler2D radius_pixels;
layout(location = 0) uniform int tile_pixels;
layout(location = 0) out vec4 largest_in_front;

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * tile_pixels;
    ivec2 end = min(first + tile_pixels, textureSize(radius_pixels, 0));
    float largest = 0.0;
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) largest = max(largest, -texelFetch(radius_pixels, ivec2(x, y), 0).r);
    }
    largest_in_front = vec4(largest, 0.0, 0.0, 1.0);
}
