// Limits, bindings and blocks that C++ and GLSL share: this file is valid in both languages (the C++ side includes it
// through runtime/gl/shared_blocks.h). No vec3 and no bool in a block, so that std140, std430 and C++ agree; a check at
// program load compares the driver's offsets with offsetof.

// Lights of a frame: key, fill and rim.
#define BLUSH_LIGHT_COUNT 3

// Uniform blocks.
#define BLUSH_FRAME_BINDING 0
#define BLUSH_DRAW_BINDING 1
#define BLUSH_MATERIAL_BINDING 2

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

// Storage block of the joints.
#define BLUSH_JOINTS_BINDING 0

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

// Texture units.
#define BLUSH_BASE_COLOR_UNIT 0
#define BLUSH_METALLIC_ROUGHNESS_UNIT 1
#define BLUSH_NORMAL_MAP_UNIT 2
#define BLUSH_OCCLUSION_UNIT 3
#define BLUSH_EMISSIVE_UNIT 4
#define BLUSH_SCENE_COLOR_UNIT 0
// Of the antialiasing passes (runtime/antialias/).
#define BLUSH_AA_COLOR_UNIT 0
#define BLUSH_AA_DEPTH_UNIT 1
#define BLUSH_AA_EDGES_UNIT 0
#define BLUSH_AA_AREAS_UNIT 1
#define BLUSH_AA_DIAGONAL_AREAS_UNIT 2
#define BLUSH_AA_SEARCH_UNIT 3
#define BLUSH_AA_WEIGHTS_UNIT 1

// Layout of the antialiasing tables; runtime/antialias/ holds them to rig/antialias/.
#define BLUSH_ORTHOGONAL_DISTANCES 64
#define BLUSH_DIAGONAL_DISTANCES 20
#define BLUSH_MLAA_DISTANCES 9
#define BLUSH_SEARCH_TABLE_RIGHT 33
#define BLUSH_FEWEST_DIAGONAL_EDGES 5

struct Light {
    vec4 direction_world;  // xyz: unit vector towards the light; w unused
    vec4 radiance_linear;  // rgb: irradiance on a facing surface / pi, so that white reflects this radiance; w unused
};

BLUSH_UNIFORM_BLOCK(FrameBlock, BLUSH_FRAME_BINDING) {
    mat4 clip_from_world;
    vec4 camera_world;  // xyz: position; w unused
    Light lights[BLUSH_LIGHT_COUNT];
    vec4 sky_radiance_linear;     // ambient from above
    vec4 ground_radiance_linear;  // ambient from below
};

BLUSH_UNIFORM_BLOCK(DrawBlock, BLUSH_DRAW_BINDING) {
    mat4 world_from_mesh;
    mat4 world_normal_from_mesh;  // inverse transpose of the upper left 3x3
};

BLUSH_UNIFORM_BLOCK(MaterialBlock, BLUSH_MATERIAL_BINDING) {
    vec4 base_color_linear;
    vec4 emissive_linear;      // rgb; w unused
    vec4 metallic_roughness_normal_occlusion;  // factors; z scales the normal map
    vec4 alpha;                // x: cutoff, or -1 without alpha test; y: 1 when the surface is opaque; zw unused
    vec4 uv_rows[10];          // two rows of the 3x2 texture-coordinate transform of each of the five textures
    ivec4 uv_sets;             // texture-coordinate set of base colour, metallic-roughness, normal, occlusion
    ivec4 emissive_uv_set;     // x: of emissive; yzw unused
};
