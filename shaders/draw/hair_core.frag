// The opaque core of blended hair: its depth is written before anything of hair is shaded, so that only what is seen is,
// and the order of strands, depth of field and shadows are right.
#include "shared.glsl"

#ifdef BASE_COLOR_MAP
layout(binding = BASE_COLOR_MAP) uniform sampler2D base_color_map;
in vec2 texture_uv[6];
#endif

void main() {
    float opacity = base_color_linear.a;
#ifdef BASE_COLOR_MAP
    opacity *= texture(base_color_map, texture_uv[0]).a;
#endif
    if (opacity < max(alpha.x, BLUSH_HAIR_CORE_OPACITY)) discard;
}
