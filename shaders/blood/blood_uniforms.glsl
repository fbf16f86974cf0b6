// Numbers of the blood of one character. Valid in GLSL and in C++.
struct BloodUniforms {
    float factor;       // on the hemoglobin of the whole face
    float largest;      // hemoglobin that a table coordinate of 1 stands for
    float table_nodes;  // of a side of the table of skin's colour
    float unused;
};
