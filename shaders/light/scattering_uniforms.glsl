// What one character's skin writes for the diffusion on the screen. Valid in GLSL and in C++.
struct ScatteringUniforms {
    float albedo_before;  // share of the albedo that light meets before the diffusion, as an exponent
    float unused_0, unused_1, unused_2;
};
