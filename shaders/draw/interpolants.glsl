// What is known of a place before any map is read. Drawn forward or in texture space it comes from the rasteriser; a
// visibility buffer rebuilds it from the triangle.

// Texture coordinates, and how they change from a pixel to the next, across and down.
struct Uv {
    vec2 at, dx, dy;
};

// All maps with mip levels are read here. A pass without quads of pixels, such as a compute shader, has
// textureGrad(map, uv.at, uv.dx, uv.dy) in its place.
vec4 sampled(sampler2D map, Uv uv) { return texture(map, uv.at); }

struct Interpolants {
    vec3 position_world;
    vec3 position_dx, position_dy;  // how it changes from a pixel to the next, across and down
    vec3 normal_world;              // of any length
    vec4 tangent_world;
    vec4 ambient_visibility;        // rgb: share of the ambient light that arrives; a: of the directions that are open
    Uv layout_uv;                   // of the face's own maps
    Uv texture_uv[6];               // of each texture of the material, in the order of MaterialBlock
    bool front_facing;
};
