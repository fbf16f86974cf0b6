// How light passes one character's thin parts. Valid in GLSL and in C++.
struct TranslucencyUniforms {
    float strength;
    float drawn_in_mm;  // along its normal, before a point's depth is looked up
    float thickest_mm;  // that anything passes
    float unused;
    vec4 profile[BLUSH_MOST_GAUSSIANS];  // rgb: weight of a Gaussian; w: -1 / (2 variance), 1/mm^2; 0: no such term
};
