// Shadow maps of the host's lights, as one character sees them. Valid in GLSL and in C++.
struct HostShadowsUniforms {
    mat4 clip_from_world[BLUSH_MOST_HOST_SHADOWS];
    vec4 look_up[BLUSH_MOST_HOST_SHADOWS];  // x: step off the surface along its normal, world units; y: 1 where clip z
                                            // runs from 0; z: 1 where near is 1; w unused
};
