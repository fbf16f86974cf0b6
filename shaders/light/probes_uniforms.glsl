// Light from all around as the probes near one character tell it. Valid in GLSL and in C++.
struct ProbesUniforms {
    vec4 radiance_sh[9];  // rgb: of the probes together, by their shares
    float share;          // of the probes; the rest is the scene's own light from all around
    float unused_0, unused_1, unused_2;
};
