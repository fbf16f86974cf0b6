// How the environment map is read. Valid in GLSL and in C++.
struct EnvironmentUniforms {
    float factor;      // on its radiance
    float last_level;  // of its mip levels, the roughest mirror's
    float turn;        // about +Y, radians
    float unused;
};
