// Lists the tiles with edges. One invocation a tile.
#include "antialias/antialias_tiles.glsl"

layout(local_size_x = 64) in;
// Bilinear, with a border without edges.
layout(binding = BLUSH_AA_EDGES_UNIT) uniform sampler2D edges;

void main() {
    uint tile = gl_GlobalInvocationID.x;
    if (tile >= tiles.capacity) return;
    vec2 first = vec2(tile % tiles.columns, tile / tiles.columns) * float(BLUSH_AA_TILE_PIXELS);
    // A fetch between four texels is 0 where none of them has an edge. One row and column more than the tile has: the
    // weights of a texel change what is left of it and above it too.
    vec2 sum = vec2(0.0);
    for (int y = 1; y <= BLUSH_AA_TILE_PIXELS + 1; y += 2) {
        for (int x = 1; x <= BLUSH_AA_TILE_PIXELS + 1; x += 2) {
            sum += textureLod(edges, (first + vec2(x, y)) / vec2(textureSize(edges, 0)), 0.0).rg;
        }
    }
    if (sum != vec2(0.0)) tiles.list[atomicAdd(tiles.tile_count, 1u)] = tile;
}
