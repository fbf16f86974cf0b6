// Wrinkles on the base normal (jimenez-2012, 8.2, listing 8.1). The zones share one map, so that their weighted masks are
// summed before it is read: the eight additions of the listing become one.
layout(binding = WRINKLES_UNIT) uniform sampler2D wrinkle_map;
layout(binding = WRINKLES_UNIT + 1) uniform sampler2DArray wrinkle_masks;

// Texture coordinates of the wrinkle maps, which may show a part of the layout.
Uv wrinkle_uv(Uv layout_uv) {
    return Uv(layout_uv.at * wrinkles.part.xy + wrinkles.part.zw, layout_uv.dx * wrinkles.part.xy,
              layout_uv.dy * wrinkles.part.xy);
}

float wrinkle_strength(Uv uv) {
    float strength = 0.0;
    for (int mask = 0; mask < BLUSH_MOST_WRINKLE_MASKS; ++mask) {
        // A mask of which no zone acts is not read: the same for the whole draw.
        if (wrinkles.weights[mask] == vec4(0.0)) continue;
        strength += dot(texture(wrinkle_masks, vec3(uv.at, mask)), wrinkles.weights[mask]);
    }
    return strength;
}

// `base`: a tangent-space normal of any length. A normal is its partial derivatives and 1, times its z: adding
// derivatives needs no division. Derivatives of zero leave it as it is to the bit.
vec3 wrinkled(vec3 base, Uv uv, float strength) {
#ifdef WRINKLE_DIFFERENCES
    // 8.2.1: the base is of unit length when the difference is added to it.
    float length2 = dot(base, base);
    base = length2 > 1e-12 ? base * inversesqrt(length2) : vec3(0.0, 0.0, 1.0);
    return base + sampled(wrinkle_map, uv).xyz * strength;
#else
    base.xy += base.z * (sampled(wrinkle_map, uv).xy * (strength * wrinkles.range));
    return base;
#endif
}

void wrinkles_relief(Interpolants at, inout Relief relief) {
    Uv uv = wrinkle_uv(at.layout_uv);
    float strength = wrinkle_strength(uv);
    if (strength == 0.0) return;
    relief.normal = wrinkled(relief.normal, uv, strength);
    relief.bent = true;
}
