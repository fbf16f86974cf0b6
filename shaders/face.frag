// Linear HDR shading of the face: three lights and a hemisphere of ambient light on a Lambert and GGX surface
// (glTF 2.0, appendix B: metallic-roughness). Skin scattering takes this room over later.
#include "shared.glsl"

in vec3 position_world;
in vec3 normal_world;
in vec4 tangent_world;
in vec2 texture_uv[5];

// Permutations: a map that the material lacks is not fetched (BASE_COLOR_MAP, METALLIC_ROUGHNESS_MAP, NORMAL_MAP,
// OCCLUSION_MAP, EMISSIVE_MAP).
layout(binding = BLUSH_BASE_COLOR_UNIT) uniform sampler2D base_color_map;
layout(binding = BLUSH_METALLIC_ROUGHNESS_UNIT) uniform sampler2D metallic_roughness_map;
layout(binding = BLUSH_NORMAL_MAP_UNIT) uniform sampler2D normal_map;
layout(binding = BLUSH_OCCLUSION_UNIT) uniform sampler2D occlusion_map;
layout(binding = BLUSH_EMISSIVE_UNIT) uniform sampler2D emissive_map;

layout(location = 0) out vec4 radiance_linear;

const float pi = 3.14159265358979;
// The largest finite half float is 65504; a highlight beyond this would be infinite in the scene colour.
const float largest_radiance = 60000.0;

vec3 unit_or(vec3 v, vec3 fallback) {
    float length2 = dot(v, v);
    return length2 > 1e-30 && length2 < 1e37 ? v * inversesqrt(length2) : fallback;
}

vec3 shading_normal(vec3 view_world) {
    vec3 n = unit_or(normal_world, view_world);
#ifdef NORMAL_MAP
    vec3 t = tangent_world.xyz - n * dot(n, tangent_world.xyz);
    if (dot(t, t) > 1e-30) {
        t = unit_or(t, vec3(1.0, 0.0, 0.0));
        vec3 b = cross(n, t) * tangent_world.w;
        vec3 m = texture(normal_map, texture_uv[2]).xyz * 2.0 - 1.0;
        m.xy *= metallic_roughness_normal_occlusion.z;
        n = unit_or(t * m.x + b * m.y + n * m.z, n);
    }
#endif
    // Both sides of a thin sheet are lit (glTF 2.0, 3.9.6); one-sided surfaces never show their back.
    return gl_FrontFacing ? n : -n;
}

// Trowbridge-Reitz distribution over 4 (n.l)(n.v), with the height-correlated Smith visibility (Heitz 2014).
float specular_ggx(float n_l, float n_v, float n_h, float ggx_alpha) {
    float a2 = ggx_alpha * ggx_alpha;
    float d = n_h * n_h * (a2 - 1.0) + 1.0;
    float distribution = a2 / (pi * d * d);
    float visibility = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2));
    return distribution * visibility;
}

void main() {
    vec4 base = base_color_linear;
#ifdef BASE_COLOR_MAP
    base *= texture(base_color_map, texture_uv[0]);
#endif
    if (base.a < alpha.x) discard;

    vec3 view = unit_or(camera_world.xyz - position_world, vec3(0.0, 0.0, 1.0));
    vec3 n = shading_normal(view);
    // Grazing pixels of interpolated normals may face away; the clamp keeps the visibility term's divisor above zero.
    float n_v = max(dot(n, view), 1e-3);

    vec2 roughness_metallic = metallic_roughness_normal_occlusion.yx;
#ifdef METALLIC_ROUGHNESS_MAP
    roughness_metallic *= texture(metallic_roughness_map, texture_uv[1]).gb;
#endif
    float metallic = clamp(roughness_metallic.y, 0.0, 1.0);
    // Below 0.045 the square of alpha underflows half precision and a highlight becomes a single burning pixel.
    float roughness = clamp(roughness_metallic.x, 0.045, 1.0);
    float occlusion = 1.0;
#ifdef OCCLUSION_MAP
    occlusion += metallic_roughness_normal_occlusion.w * (texture(occlusion_map, texture_uv[3]).r - 1.0);
#endif
    vec3 diffuse = base.rgb * (1.0 - metallic);
    vec3 f0 = mix(vec3(0.04), base.rgb, metallic);

    vec3 ambient = mix(ground_radiance_linear.rgb, sky_radiance_linear.rgb, 0.5 + 0.5 * n.y);
    vec3 result = diffuse * ambient * occlusion;
    // Ambient reflection: the hemisphere in the mirror direction, with Schlick's Fresnel damped by roughness.
    vec3 mirrored = reflect(-view, n);
    vec3 fresnel_view = f0 + (max(vec3(1.0 - roughness), f0) - f0) * pow(1.0 - min(n_v, 1.0), 5.0);
    result += fresnel_view * mix(ground_radiance_linear.rgb, sky_radiance_linear.rgb, 0.5 + 0.5 * mirrored.y) * occlusion;

    for (int i = 0; i < BLUSH_LIGHT_COUNT; ++i) {
        vec3 l = lights[i].direction_world.xyz;
        float n_l = dot(n, l);
        if (n_l <= 0.0) continue;
        vec3 h = unit_or(l + view, n);
        vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - clamp(dot(view, h), 0.0, 1.0), 5.0);
        float specular = specular_ggx(n_l, n_v, clamp(dot(n, h), 0.0, 1.0), roughness * roughness);
        // radiance_linear is irradiance / pi: Lambert's 1 / pi cancels, the specular term keeps pi.
        result += ((1.0 - fresnel) * diffuse + pi * specular * fresnel) * lights[i].radiance_linear.rgb * n_l;
    }
    vec3 emitted = emissive_linear.rgb;
#ifdef EMISSIVE_MAP
    emitted *= texture(emissive_map, texture_uv[4]).rgb;
#endif
    result += emitted;
    radiance_linear = vec4(min(result, vec3(largest_radiance)), max(base.a, alpha.y));
}
