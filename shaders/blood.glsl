// The colour of skin from melanin and hemoglobin (jimenez-2012, 7.6), as what it changes of the colour at rest: the base
// colour texture keeps all that pigments do not explain.
layout(binding = BLUSH_PIGMENT_UNIT) uniform sampler2D pigment_map;          // table coordinates of melanin, blood; skin
layout(binding = BLUSH_BLOOD_CHANGE_UNIT) uniform sampler2D blood_change_map;  // scale and offset of blood
layout(binding = BLUSH_SKIN_COLOR_UNIT) uniform sampler2D skin_color_table;

vec3 skin_color(vec2 coordinate) {
    // From the first node's centre to the last one's.
    vec2 nodes = vec2(textureSize(skin_color_table, 0));
    return texture(skin_color_table, (coordinate * (nodes - 1.0) + 0.5) / nodes).rgb;
}

vec3 flushed(vec3 base, vec2 uv) {
    vec3 pigment = texture(pigment_map, uv).xyz;
    vec2 change = texture(blood_change_map, uv).xy;
    float at_rest = blood.y * pigment.y * pigment.y * pigment.y;
    float changed = clamp(blood.x * (change.x * at_rest + change.y), 0.0, blood.y);
    changed = at_rest + pigment.z * (changed - at_rest);
    if (changed == at_rest) return base;  // to the bit
    vec3 before = skin_color(pigment.xy);
    vec3 after = skin_color(vec2(pigment.x, pow(changed / blood.y, 1.0 / 3.0)));
    return base * after / max(before, vec3(1e-4));
}
