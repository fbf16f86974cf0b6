// Limits, bindings and blocks that C++ and GLSL share: this file is valid in both languages (the C++ side includes it
// through runtime/gl/shared_blocks.h). No vec3 and no bool in a block, so that std140, std430 and C++ agree; a check at
// program load compares the driver's offsets with offsetof.

// Lights that reach one character, at most: the shader walks as many as there are. With 64 the block stays below the
// 16 KiB that GL guarantees.
#define BLUSH_MOST_LIGHTS 64
// Shadow maps of the host's lights that one character is lit by, at most.
#define BLUSH_MOST_HOST_SHADOWS 4
// Taps of the separable diffusion kernel without its centre, at most.
#define BLUSH_MOST_KERNEL_TAPS 32
// Of the skin, at any depth: keeps a camera inside the skin finite. rig/light/scatter_image.h has the same.
#define BLUSH_MOST_PIXELS_A_MM 4096.0
// Sides of the tables of the skin's surface reflection.
#define BLUSH_BECKMANN_TABLE_SIDE 128
#define BLUSH_SPECULAR_ALBEDO_COLUMNS 32
#define BLUSH_SPECULAR_ALBEDO_ROWS 16
#define BLUSH_MOST_GAUSSIANS 8

// Sides of the grid in which the exposure is metered; taps of the blur of the depth of field, at most.
#define BLUSH_EXPOSURE_CELLS 32
#define BLUSH_MOST_BLUR_TAPS 81

// Blended hair from this opacity on hides what is behind it, and casts shadows.
#define BLUSH_HAIR_CORE_OPACITY 0.7

// RGBA masks of wrinkle zones, at most: the paper's two (jimenez-2012, 8.2) and one more.
#define BLUSH_MOST_WRINKLE_MASKS 3
// Maps of blood that act at once, at most.
#define BLUSH_MOST_BLOOD_MAPS 32

// Uniform blocks.
#define BLUSH_FRAME_BINDING 0
#define BLUSH_DRAW_BINDING 1
#define BLUSH_MATERIAL_BINDING 2
#define BLUSH_EFFECTS_BINDING 3

// Storage blocks of the deformation.
#define BLUSH_FIRST_ENTRY_BINDING 0
#define BLUSH_ENTRIES_BINDING 1
#define BLUSH_WEIGHTS_BINDING 2
#define BLUSH_POSITION_DELTAS_BINDING 3
#define BLUSH_NORMAL_DELTAS_BINDING 4
#define BLUSH_TANGENT_DELTAS_BINDING 5

// Storage blocks of the normals.
#define BLUSH_POSITIONS_BINDING 0
#define BLUSH_FIRST_TRIANGLE_BINDING 1
#define BLUSH_TRIANGLES_BINDING 2

// Storage block of the shading of eyes: the finished surface's positions.
#define BLUSH_SURFACE_POSITIONS_BINDING 0
// Vertices along the edge of each lid.
#define BLUSH_LID_POINTS 12

// Storage block of the joints.
#define BLUSH_JOINTS_BINDING 0

// Storage blocks of the pins, and the size of their work group.
#define BLUSH_PIN_FROM_POSITIONS_BINDING 0
#define BLUSH_PIN_FROM_NORMALS_BINDING 1
#define BLUSH_PIN_TO_POSITIONS_BINDING 2
#define BLUSH_PIN_TO_NORMALS_BINDING 3
#define BLUSH_PIN_TO_TANGENTS_BINDING 4
#define BLUSH_PINS_BINDING 5
#define BLUSH_PIN_INVOCATIONS 64

// Storage block of the diffusion of several characters' skins, and the characters that it tells apart: further ones take
// their numbers anew from the first.
#define BLUSH_SCATTER_BINDING 0
#define BLUSH_MOST_SCATTERING 256

// Storage block of the occlusion coefficients, bound while shading.
#define BLUSH_OCCLUSION_BINDING 3

// Vertex attributes of the deformation passes. Targets of the pass-by-pass twin follow: position, normal and tangent
// deltas of target k at BLUSH_TARGET_ATTRIBUTE + 3 * k.
#define BLUSH_POSITION_ATTRIBUTE 0
#define BLUSH_NORMAL_ATTRIBUTE 1
#define BLUSH_TANGENT_ATTRIBUTE 2
#define BLUSH_REST_NORMAL_ATTRIBUTE 3
#define BLUSH_REST_TANGENT_ATTRIBUTE 4
#define BLUSH_REST_SUM_ATTRIBUTE 5
#define BLUSH_TARGET_ATTRIBUTE 5
// Targets that one pass of the twin adds: four as in the paper (jimenez-2012, 8.3: what fits in the vertex attributes);
// with tangent deltas three, since five attributes hold the surface and GL guarantees sixteen.
#define BLUSH_TARGETS_A_PASS 4
#define BLUSH_TARGETS_A_PASS_WITH_TANGENTS 3
// Vertex attributes of the passes that draw.
#define BLUSH_UV0_ATTRIBUTE 3
#define BLUSH_UV1_ATTRIBUTE 4
#define BLUSH_JOINTS_ATTRIBUTE 5
#define BLUSH_JOINT_WEIGHTS_ATTRIBUTE 6
#define BLUSH_LAST_POSITION_ATTRIBUTE 7

// Texture units. Those of shading are given out program by program (runtime/draw/shading.h).
#define BLUSH_SCENE_COLOR_UNIT 0
// Of the antialiasing passes (runtime/antialias/).
#define BLUSH_AA_COLOR_UNIT 0
#define BLUSH_AA_DEPTH_UNIT 1
#define BLUSH_AA_EDGES_UNIT 0
#define BLUSH_AA_AREAS_UNIT 1
#define BLUSH_AA_DIAGONAL_AREAS_UNIT 2
#define BLUSH_AA_SEARCH_UNIT 3
#define BLUSH_AA_WEIGHTS_UNIT 1

// Storage block of the antialiasing passes: tiles with edges, and their side. Small tiles follow a contour closely,
// large ones are fewer to draw: 16 took longer than 8 on llvmpipe (bench_antialias).
#define BLUSH_AA_TILES_BINDING 0
#define BLUSH_AA_TILE_PIXELS 8

// Layout of the antialiasing tables; runtime/antialias/ holds them to rig/antialias/.
#define BLUSH_ORTHOGONAL_DISTANCES 64
#define BLUSH_DIAGONAL_DISTANCES 20
#define BLUSH_MLAA_DISTANCES 9
#define BLUSH_SEARCH_TABLE_RIGHT 33
#define BLUSH_FEWEST_DIAGONAL_EDGES 5
#define BLUSH_SKIN_LIGHT_UNIT 0
#define BLUSH_SKIN_DEPTH_UNIT 1
#define BLUSH_SKIN_ALBEDO_UNIT 2

// All that shading calls "world" has the world's axes and units, and its origin in the middle of the head that is shaded:
// floats are finest there, wherever in the world it stands. C++ composes it in double precision.
struct Light {
    vec4 position_world;   // xyz: its place (w 1), or the unit vector towards it (w 0)
    vec4 radiance_linear;  // rgb: irradiance on a facing surface / pi, so that white reflects this radiance;
                           // w: square of the distance at which a light with a place has it
    vec4 cone_world;       // xyz: unit vector that a spot shines along; w: cosine of its rim, or -2 without a cone
    vec4 shadow;           // x: 1 with a shadow map, or -1; y: cosine where a spot begins to fade; z: texel at the map's depth 1
                           // (perspective) or anywhere, world units; w: 1 when the map is a perspective
    vec4 shadow_depth;     // x, y: near and far of the map, world units; z: size: radius of a light with a place, world
                           // units, or tangent of half the angle of a directional one; w: number of the host's shadow
                           // map, from 1, or 0
    vec4 shadow_tile;      // x, y: lower left corner of the map in the texture of all maps, z: its side, texels; w unused
    mat4 shadow_from_world;  // clip space of the shadow map
};

// One character in one picture. What effects know of it stands in a block of theirs (EffectsBlock, runtime/draw/shading.h).
BLUSH_UNIFORM_BLOCK(FrameBlock, BLUSH_FRAME_BINDING) {
    mat4 clip_from_world;
    vec4 camera_world;  // xyz: position; w unused
    vec4 depth_from_world;        // dot with (place, 1): distance along the view's axis, world units
    vec4 sky_radiance_linear;     // ambient from above; w unused
    vec4 ground_radiance_linear;  // ambient from below; w unused
    vec4 ambient_sh[9];           // rgb: radiance of white under the ambient light, by spherical harmonics of the normal;
                                  // w of the first three: radiance that comes from every side, red, green, blue
    float millimetres_a_unit;
    float unused_0, unused_1, unused_2;
    ivec4 counts;                 // x: lights; y: number of the character, from 1; zw unused
    Light lights[BLUSH_MOST_LIGHTS];
};

BLUSH_UNIFORM_BLOCK(DrawBlock, BLUSH_DRAW_BINDING) {
    mat4 world_from_mesh;  // to the world's axes, with the origin in the middle of the head
    mat4 world_normal_from_mesh;  // inverse transpose of the upper left 3x3
};

BLUSH_UNIFORM_BLOCK(MaterialBlock, BLUSH_MATERIAL_BINDING) {
    vec4 base_color_linear;
    vec4 emissive_linear;      // rgb; w unused
    vec4 metallic_roughness_normal_occlusion;  // factors; z scales the normal map
    vec4 alpha;                // x: cutoff, or -1 without alpha test; y: 1 when the surface is opaque; z: 1 when the base
                               // colour's alpha is how far light scatters; w: factor on reflection
    vec4 uv_rows[12];          // two rows of the 3x2 texture-coordinate transform of each of the six textures
    ivec4 uv_sets;             // texture-coordinate set of base colour, metallic-roughness, normal, occlusion
    ivec4 emissive_uv_set;     // x: of emissive; y: of specular; zw unused
};
