// One square for each tile of the list.
#include "antialias/antialias_tiles.glsl"

layout(location = 8) uniform vec2 size_pixels;

void main() {
    uint tile = tiles.list[gl_InstanceID];
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    vec2 place = (vec2(tile % tiles.columns, tile / tiles.columns) + corner) * float(BLUSH_AA_TILE_PIXELS);
    gl_Position = vec4(place / size_pixels * 2.0 - 1.0, 0.0, 1.0);
}
