// Numbers of the wrinkles of one character. Valid in GLSL and in C++.
struct WrinklesUniforms {
    vec4 weights[BLUSH_MOST_WRINKLE_MASKS];  // of the zones, as the masks' channels hold them
    vec4 part;    // xy: factor on texture coordinates, zw: what is added, for maps of a part of the layout
    float range;  // derivative that the map's 1 stands for
    float unused_0, unused_1, unused_2;
};
