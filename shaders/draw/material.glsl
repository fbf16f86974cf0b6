// The record as a glTF 2.0 material's factors and maps have it (metallic-roughness). A map that the material lacks is not
// fetched; of those that it has, BASE_COLOR_MAP, METALLIC_ROUGHNESS_MAP, NORMAL_MAP, OCCLUSION_MAP, EMISSIVE_MAP and SPECULAR_MAP are the units.

#ifdef BASE_COLOR_MAP
layout(binding = BASE_COLOR_MAP) uniform sampler2D base_color_map;
#endif
#ifdef METALLIC_ROUGHNESS_MAP
layout(binding = METALLIC_ROUGHNESS_MAP) uniform sampler2D metallic_roughness_map;
#endif
#ifdef NORMAL_MAP
layout(binding = NORMAL_MAP) uniform sampler2D normal_map;
#endif
#ifdef OCCLUSION_MAP
layout(binding = OCCLUSION_MAP) uniform sampler2D occlusion_map;
#endif
#ifdef EMISSIVE_MAP
layout(binding = EMISSIVE_MAP) uniform sampler2D emissive_map;
#endif
#ifdef SPECULAR_MAP
layout(binding = SPECULAR_MAP) uniform sampler2D specular_map;
#endif

vec4 material_color(Interpolants at) {
    vec4 color = base_color_linear;
#ifdef BASE_COLOR_MAP
    color *= sampled(base_color_map, at.texture_uv[0]);
#endif
    return color;
}

Relief material_relief(Interpolants at) {
    Relief relief = Relief(vec3(0.0, 0.0, 1.0), false);
#ifdef NORMAL_MAP
    // Partial derivatives (jimenez-2012, 8.2). Flat ones leave the vertex normal as it is, to the bit.
    relief.normal.xy = sampled(normal_map, at.texture_uv[2]).xy * metallic_roughness_normal_occlusion.z;
    relief.bent = relief.normal.xy != vec2(0.0);
#endif
    return relief;
}

// `color`: of the base colour's texture, wherever in it the place is seen.
Surface material_surface(int model, Interpolants at, vec4 color) {
    Surface s;
    s.model = model;
    s.position = at.position_world;
    s.footprint = length(abs(at.position_dx) + abs(at.position_dy));
    s.layout_uv = at.layout_uv.at;
    s.visibility = at.ambient_visibility;

    hook_colour(at, color.rgb);
    s.base_color = color.rgb;
    s.opacity = color.a;

    Relief relief = material_relief(at);
    hook_relief(at, relief);
    s.vertex_normal = unit_or(at.normal_world, towards_camera(s.position));
    s.normal = bent_normal(s.vertex_normal, at.tangent_world, relief);
    // Both sides of a thin sheet are lit (glTF 2.0, 3.9.6); one-sided surfaces never show their back.
    if (!at.front_facing) {
        s.vertex_normal = -s.vertex_normal;
        s.normal = -s.normal;
    }

    vec2 roughness_metallic = metallic_roughness_normal_occlusion.yx;
#ifdef METALLIC_ROUGHNESS_MAP
    roughness_metallic *= sampled(metallic_roughness_map, at.texture_uv[1]).gb;
#endif
    s.metallic = clamp(roughness_metallic.y, 0.0, 1.0);
    // Below 0.045 the square of alpha underflows half precision and a highlight becomes a single burning pixel.
    s.roughness = clamp(roughness_metallic.x, 0.045, 1.0);
    s.specular = alpha.w;
#ifdef SPECULAR_MAP
    s.specular *= sampled(specular_map, at.texture_uv[5]).a;
#endif
    s.occlusion = 1.0;
#ifdef OCCLUSION_MAP
    s.occlusion += metallic_roughness_normal_occlusion.w * (sampled(occlusion_map, at.texture_uv[3]).r - 1.0);
#endif
    s.emitted = emissive_linear.rgb;
#ifdef EMISSIVE_MAP
    s.emitted *= sampled(emissive_map, at.texture_uv[4]).rgb;
#endif
    s.along = s.normal;
    s.exposed = 1.0;
    s.scatter = 1.0;
    hook_surface(at, relief, s);
    return s;
}
