// The surface of skin: Kelemen and Szirmay-Kalos 2001 with Beckmann's distribution from a table, Schlick's Fresnel term,
// and the light that it leaves for what is below (chappuis-2011, 2.3 and 2.6). Twin: rig/light/skin_reflectance.cpp.

layout(binding = REFLECTION_UNIT) uniform sampler2D beckmann_map;             // 0.5 D^0.1 by n.h and roughness
layout(binding = REFLECTION_UNIT + 1) uniform sampler2D specular_albedo_map;  // r: by n.l and roughness; g: mean

// Reflectance at normal incidence of an index of refraction of 1.4 (d'Eon and Luebke 2007). rig/light/skin_reflectance.h.
const float skin_f0 = 0.028;

// Column of a cosine in a table whose first and last columns are 0 and 1.
float table_column(float cosine, float columns) { return (clamp(cosine, 0.0, 1.0) * (columns - 1.0) + 0.5) / columns; }

// x: share of the light from a direction (or towards a view) that the surface reflects; y: its mean over directions.
vec2 specular_albedo(float n_l, float roughness) {
    return texture(specular_albedo_map, vec2(table_column(n_l, float(BLUSH_SPECULAR_ALBEDO_COLUMNS)), roughness)).rg;
}

// Of unit vectors n and view, and h = l + view as it is.
float skin_specular(vec3 n, vec3 h, vec3 view, float roughness) {
    float h2 = dot(h, h);
    if (h2 < 1e-8) return 0.0;  // light from straight behind the surface's edge
    vec3 unit_h = h * inversesqrt(h2);
    float column = table_column(dot(n, unit_h), float(BLUSH_BECKMANN_TABLE_SIDE));
    float stored = 2.0 * texture(beckmann_map, vec2(column, roughness)).r;
    float distribution = pow(stored, 10.0);
    float fresnel = skin_f0 + (1.0 - skin_f0) * pow(1.0 - clamp(dot(view, unit_h), 0.0, 1.0), 5.0);
    return distribution * fresnel / (pi * h2);
}

float skin_roughness(Surface s) { return clamp(reflection.roughness * (s.roughness / 0.5), 0.08, 0.95); }

void reflection_split(Surface s, vec3 view, vec3 l, inout Split split) {
    float roughness = skin_roughness(s), intensity = reflection.intensity * s.specular;
    split.entering = vec3(1.0 - intensity * specular_albedo(dot(s.normal, l), roughness).x);
    split.reflected = vec3(pi * intensity * skin_specular(s.normal, l + view, view, roughness));
}

// Uniform light from everywhere is reflected by the directional albedo of the view: reciprocity. Light that comes from
// below and is sent back at the surface leaves elsewhere: the division by what the surface lets out on the average keeps a
// white furnace white (Kelemen and Szirmay-Kalos 2001, 3). chappuis-2011, 2.6, leaves it out and loses some 4 %.
void reflection_around(Surface s, vec3 view, Ambient around, inout Lighting lit) {
    vec2 mirror = reflection.intensity * s.specular * specular_albedo(cosine_to_view(s, view), skin_roughness(s));
    lit.entering = around.white * s.occlusion * (1.0 - mirror.y);
    lit.reflected = around.mirrored * s.occlusion * mirror.x;
    lit.leaving = vec3((1.0 - mirror.x) / (1.0 - mirror.y));
}
