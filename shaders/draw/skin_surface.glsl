// The surface of skin: Kelemen and Szirmay-Kalos 2001 with Beckmann's distribution from a table, Schlick's Fresnel term,
// and the light that it leaves for what is below (chappuis-2011, 2.3 and 2.6). Twin: rig/light/skin_reflectance.cpp.

layout(binding = BLUSH_BECKMANN_UNIT) uniform sampler2D beckmann_map;  // 0.5 D^0.1 by n.h and roughness
layout(binding = BLUSH_SPECULAR_ALBEDO_UNIT) uniform sampler2D specular_albedo_map;  // r: by n.l and roughness; g: mean

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
    return distribution * fresnel / (3.14159265358979 * h2);
}

#ifdef TRANSLUCENCY
// Light through thin parts (jimenez-2012, chapter 5): share of the light's radiance that comes out here.
vec3 transmitted(Light light, InMap map, vec3 l, vec3 vertex_normal) {
    // The reversed vertex normal, some 17 degrees early so that it meets what the front reflects (eq. 5.13).
    float back = max(0.3 - dot(vertex_normal, l), 0.0);
    if (back == 0.0 || light.shadow.x < 0.0) return vec3(0.0);
    float thickness_mm =
        depth_inside(light, map.here - map.along_normal * (translucency.y / skin.x), translucency.z / skin.x) * skin.x;
    // The paper leaves the thickness short by what the point was drawn in; a slab has it all, up to 45 degrees from its
    // normal. Where light grazes more, a surface is no slab's, and its own depth is the better guess.
    float facing_away = max(-dot(vertex_normal, l), 0.0), bounded = max(facing_away, 0.7);
    thickness_mm += translucency.y * facing_away / (bounded * bounded);
    if (!(thickness_mm < translucency.z)) return vec3(0.0);
    vec3 passed = vec3(0.0);  // T(s), eq. 5.12
    for (int k = 0; k < BLUSH_MOST_GAUSSIANS; ++k) {
        passed += profile[k].rgb * exp(thickness_mm * thickness_mm * profile[k].w);
    }
    return translucency.x * back * passed;
}
#endif
