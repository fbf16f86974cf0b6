// The colour of skin from melanin and hemoglobin (jimenez-2012, 7.6). With PIGMENT_COLOR that is the base colour: residual
// times table, in one lookup of the table. Without, it is what blood changes of the colour at rest, and the base colour
// texture keeps all that pigments do not explain.
layout(binding = BLOOD_UNIT) uniform sampler2D pigment_map;          // table coordinates of melanin, blood; skin
layout(binding = BLOOD_UNIT + 1) uniform sampler2D blood_change_map;  // scale and offset of blood
layout(binding = BLOOD_UNIT + 2) uniform sampler2D skin_color_table;

#ifdef PIGMENT_COLOR
layout(binding = BLOOD_UNIT + 3) uniform sampler2D residual_map;
#endif

vec3 skin_color(vec2 coordinate) {
    // From the first node's centre to the last one's.
    return texture(skin_color_table, (coordinate * (blood.table_nodes - 1.0) + 0.5) / blood.table_nodes).rgb;
}

vec3 flushed(vec3 base, Uv uv) {
    vec3 pigment = sampled(pigment_map, uv).xyz;
    if (pigment.z == 0.0) return base;  // not skin
    vec2 change = texture(blood_change_map, uv.at).xy;
    float at_rest = blood.largest * pigment.y * pigment.y * pigment.y;
    float changed = clamp(blood.factor * (change.x * at_rest + change.y), 0.0, blood.largest);
    changed = at_rest + pigment.z * (changed - at_rest);
    vec2 coordinate = vec2(pigment.x, pow(changed / blood.largest, 1.0 / 3.0));
#ifdef PIGMENT_COLOR
    return mix(base, sampled(residual_map, uv).rgb * skin_color(coordinate), pigment.z);
#else
    if (changed == at_rest) return base;  // to the bit
    return base * skin_color(coordinate) / max(skin_color(pigment.xy), vec3(1e-4));
#endif
}

void blood_colour(Interpolants at, inout vec3 color) { color = flushed(color, at.layout_uv); }
