// Poses of one character's occlusion coefficients. Valid in GLSL and in C++.
struct OcclusionUniforms {
    int poses;
    int vertices;  // of each pose
    int bounces;   // 1: surfaces send light on
    int unused;
    vec4 weights[2];  // of the poses
};
