// Where one character's eyes, lids and mouth are. Valid in GLSL and in C++.
struct PartsUniforms {
    float lid_shade, iris_depth, mouth_shade;  // strengths
    float tear_roughness;                      // of the eye's film of tears
    vec4 mouth_front;    // xyz: a place on the plane before the teeth; w unused
    vec4 mouth_forward;  // xyz: unit vector out of the mouth; w unused
    vec4 eyes[2];        // xyz: centre; w: radius, world units
    mat4 world_from_lids;
    int eyes_known, first_pole, second_pole;  // poles: vertices
    int lids_known;
    ivec4 lid_points[BLUSH_LID_POINTS];  // vertices: upper and lower lid of the first eye, of the second
};
