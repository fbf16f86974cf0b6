// Tiles of the picture with an edge in or beside them, as a list that the passes behind the edge pass are drawn
// over: the rest of the picture costs them nothing. (jimenez-2012, 9.2 uses the stencil buffer for this; a
// list needs nothing of the targets.) runtime/antialias/edge_tiles.h has the C++ side.
#include "shared.glsl"

layout(std430, binding = BLUSH_AA_TILES_BINDING) buffer EdgeTiles {
    uint vertices, tile_count, first_vertex, first_instance;  // what glDrawArraysIndirect() reads
    uint columns, capacity;                                   // tiles in a row, and in the picture
    uint list[];                                              // the first tile_count of `capacity`
} tiles;
