// The surface of one character's skin. Valid in GLSL and in C++.
struct ReflectionUniforms {
    float roughness;  // Beckmann's m of skin whose material has roughness 0.5
    float intensity;
    float unused_0, unused_1;
};
