// Linear HDR shading of the face. Skin: jimenez-2012, chapters 5 and 6, chappuis-2011, chapters 2 and 3. All else: a
// Lambert and GGX surface (glTF 2.0, appendix B: metallic-roughness).
#include "shared.glsl"

// At the centroid of the samples that are covered: the middle of a pixel may lie beyond a triangle's edge, and where that
// is seen from its side, far beyond what the surface has there.
centroid in vec3 position_world;
centroid in vec3 normal_world;
centroid in vec4 tangent_world;
centroid in vec2 texture_uv[6];
centroid in vec2 layout_uv;
#ifdef AMBIENT_OCCLUSION
centroid in vec4 ambient_visibility;
#endif

// Permutations: a map that the material lacks is not fetched (BASE_COLOR_MAP, METALLIC_ROUGHNESS_MAP, NORMAL_MAP,
// OCCLUSION_MAP, EMISSIVE_MAP, SPECULAR_MAP); SKIN is the material's, SCATTER (the skin's diffuse light goes to targets of its own),
// SKIN_REFLECTION, SHADOWS, TRANSLUCENCY, ENVIRONMENT, AMBIENT_OCCLUSION, WRINKLES and BLOOD are the frame's.
layout(binding = BLUSH_BASE_COLOR_UNIT) uniform sampler2D base_color_map;
layout(binding = BLUSH_METALLIC_ROUGHNESS_UNIT) uniform sampler2D metallic_roughness_map;
layout(binding = BLUSH_NORMAL_MAP_UNIT) uniform sampler2D normal_map;
layout(binding = BLUSH_OCCLUSION_UNIT) uniform sampler2D occlusion_map;
layout(binding = BLUSH_EMISSIVE_UNIT) uniform sampler2D emissive_map;

layout(binding = BLUSH_SPECULAR_UNIT) uniform sampler2D specular_map;

layout(location = 0) out vec4 radiance_linear;
#ifdef SCATTER
// Light that enters the skin, the albedo that it meets when it leaves, and depth, each times the matte (how much of the
// pixel is skin). What is not skin writes 0, and by blending takes its own share from the skin behind.
layout(location = 1) out vec4 skin_light;
layout(location = 2) out vec4 skin_albedo;
layout(location = 3) out vec4 skin_depth_mm;
#endif

#ifdef SHADOWS
#include "light/shadow.glsl"
#endif
#ifdef ENVIRONMENT
#include "light/environment.glsl"
#endif
#ifdef SKIN
#include "draw/skin_surface.glsl"
#endif
#ifdef WRINKLES
#include "wrinkles/wrinkles.glsl"
#endif
#ifdef BLOOD
#include "blood/blood.glsl"
#endif

const float pi = 3.14159265358979;
// The largest finite half float is 65504; a highlight beyond this would be infinite in the scene colour.
const float largest_radiance = 60000.0;

vec3 unit_or(vec3 v, vec3 fallback) {
    float length2 = dot(v, v);
    return length2 > 1e-30 && length2 < 1e37 ? v * inversesqrt(length2) : fallback;
}

#if defined(EYE) || defined(MOUTH) || defined(HAIR)
#include "draw/parts.glsl"
#endif

vec3 shading_normal(vec3 view_world) {
    vec3 n = unit_or(normal_world, view_world);
#if defined(NORMAL_MAP) || defined(WRINKLES)
    vec3 m = vec3(0.0, 0.0, 1.0);
    bool bent = false;
#ifdef NORMAL_MAP
    // Partial derivatives (jimenez-2012, 8.2). Flat ones leave the geometric normal as it is, to the bit.
    m.xy = texture(normal_map, texture_uv[2]).xy * metallic_roughness_normal_occlusion.z;
    bent = m.xy != vec2(0.0);
#endif
#ifdef WRINKLES
    vec2 fold_uv = wrinkle_uv(layout_uv);
    float strength = wrinkle_strength(fold_uv);
    if (strength != 0.0) {
        m = wrinkled(m, fold_uv, strength);
        bent = true;
    }
#endif
    vec3 t = tangent_world.xyz - n * dot(n, tangent_world.xyz);
    if (bent && dot(t, t) > 1e-30) {
        t = unit_or(t, vec3(1.0, 0.0, 0.0));
        vec3 b = cross(n, t) * tangent_world.w;
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

struct Arriving {
    vec3 direction;  // unit, towards the light
    vec3 radiance;   // of a white surface that faces it
};

Arriving arriving(Light light) {
    Arriving result;
    result.direction = light.position_world.xyz;
    result.radiance = light.radiance_linear.rgb;
    if (light.position_world.w != 0.0) {
        vec3 to = light.position_world.xyz - position_world;
        // A light on the surface would be infinitely bright there; a thousandth of its own distance is near enough.
        float distance2 = max(dot(to, to), 1e-6 * light.radiance_linear.w);
        result.direction = unit_or(to, vec3(0.0, 1.0, 0.0));
        result.radiance *= light.radiance_linear.w / max(distance2, 1e-30);
    }
    if (light.cone_world.w > -1.5) {
        result.radiance *= smoothstep(light.cone_world.w, max(light.shadow.y, light.cone_world.w + 1e-4),
                                      dot(-result.direction, light.cone_world.xyz));
    }
    return result;
}

#ifdef HAIR
// An edge of a cut-out strand covers a share of the samples, as a triangle's edge does: the cut-off stands in the middle
// of a step one pixel wide. Which samples goes round from pixel to pixel, so that overlapping strands do not always hide
// the same ones.
void cover_samples(float opacity) {
    gl_SampleMask[0] = (1 << max(gl_NumSamples, 1)) - 1;
    if (gl_NumSamples < 2 || alpha.x < 0.0) {
        if (opacity < alpha.x) discard;
        return;
    }
    float share = clamp((opacity - alpha.x) / max(fwidth(opacity), 1e-3) + 0.5, 0.0, 1.0);
    int count = int(share * float(gl_NumSamples) + 0.5);
    if (count == 0) discard;
    int turn = (int(gl_FragCoord.x) + 2 * int(gl_FragCoord.y)) % gl_NumSamples;
    int mask = ((1 << count) - 1) << turn;
    gl_SampleMask[0] = (mask | mask >> gl_NumSamples) & ((1 << gl_NumSamples) - 1);
}
#endif

void main() {
    vec4 base = base_color_linear;
#ifdef EYE
    Eye eye = eye_here(position_world);
    vec3 towards_camera = unit_or(camera_world.xyz - position_world, vec3(0.0, 0.0, 1.0));
    vec2 seen_iris = iris_offset(eye, position_world, unit_or(normal_world, towards_camera), towards_camera, texture_uv[0]);
#endif
#ifdef BASE_COLOR_MAP
#ifdef EYE
    base *= textureGrad(base_color_map, texture_uv[0] + seen_iris, dFdx(texture_uv[0]), dFdy(texture_uv[0]));
#else
    base *= texture(base_color_map, texture_uv[0]);
#endif
#endif
#ifdef HAIR
    cover_samples(base.a);
    // Nothing is left of it in 8 bits: most of a card.
    if (alpha.y == 0.0 && base.a < 1.0 / 255.0) discard;
    if (base.a >= BLUSH_HAIR_CORE_OPACITY) base.a = 1.0;
#else
    if (base.a < alpha.x) discard;
#endif
    float scatter_strength = alpha.z != 0.0 ? base.a : 1.0;
    // KHR_materials_specular: a factor on what a surface that is no metal reflects.
    float specular_factor = alpha.w;
#ifdef SPECULAR_MAP
    specular_factor *= texture(specular_map, texture_uv[5]).a;
#endif

#ifdef BLOOD
    base.rgb = flushed(base.rgb, layout_uv);
#endif

    vec3 view = unit_or(camera_world.xyz - position_world, vec3(0.0, 0.0, 1.0));
    vec3 n = shading_normal(view);
    vec3 vertex_normal = unit_or(normal_world, view);
    if (!gl_FrontFacing) vertex_normal = -vertex_normal;
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
    vec3 diffuse_color = base.rgb * (1.0 - metallic);
    vec3 f0 = mix(vec3(0.04 * specular_factor), base.rgb, metallic);
    vec3 f90 = vec3(mix(specular_factor, 1.0, metallic));

    vec3 mirrored = reflect(-view, n);
    // Radiance that a white surface reflects, and what a mirror as rough as this one shows.
#ifdef ENVIRONMENT
    vec3 ambient = environment_ambient(n);
    vec3 ambient_mirrored = environment_mirrored(mirrored, roughness);
#else
    vec3 ambient = mix(ground_radiance_linear.rgb, sky_radiance_linear.rgb, 0.5 + 0.5 * n.y);
    vec3 ambient_mirrored = mix(ground_radiance_linear.rgb, sky_radiance_linear.rgb, 0.5 + 0.5 * mirrored.y);
#endif
#ifdef AMBIENT_OCCLUSION
    // What a vertex's own normal loses, its pixels lose, whatever their normals: the detail of maps stays.
    vec4 visible = clamp(ambient_visibility, 0.0, 1.0);
    ambient *= visible.rgb;
    // What hides a place shines as it does itself: with_bounces() in rig/light/occlusion.cpp.
    if (occlusion_poses.z != 0) ambient /= max(1.0 - min(diffuse_color, vec3(1.0)) * (1.0 - visible.a), vec3(1e-3));
    ambient_mirrored *= visible.a;
#endif
#ifdef EYE
    float lids = lid_visibility(eye, position_world);
    ambient *= lids;
    ambient_mirrored *= lids;
    // A film of tears lies over everything: its own reflection (1.336) and nothing rougher below.
    roughness = parts.w;
    f0 = vec3(0.0207);
    // The iris is a shallow bowl: light from one side brightens the other.
    vec3 inner = eye.index < 0 ? n : unit_or(mix(n, eye.axis - 0.7 * (n - eye.axis * dot(n, eye.axis)), over_iris(eye, position_world)), n);
#endif
#ifdef HAIR
    vec3 strand = strand_direction(position_world, texture_uv[0], n);
    // What the texture has darker than the material's colour lies among other strands.
    vec3 whole = max(base_color_linear.rgb, vec3(1e-4));
    float exposed = clamp(dot(base.rgb / whole, vec3(1.0 / 3.0)), 0.0, 1.0);
#endif
    vec3 entering = vec3(0.0);  // radiance that white would reflect, of the light that is left for the inside
    vec3 surface = vec3(0.0);   // reflected at the surface
    vec3 leaving = vec3(1.0);   // share that the surface lets out again

#if defined(SKIN) && defined(SKIN_REFLECTION)
    float skin_rough = clamp(skin.z * (roughness / 0.5), 0.08, 0.95);
    float skin_intensity = skin.w * specular_factor;
    vec2 mirror_view = skin_intensity * specular_albedo(n_v, skin_rough);
    // Light that comes from below and is sent back at the surface leaves elsewhere: the division by what the surface
    // lets out on the average keeps a white furnace white (Kelemen and Szirmay-Kalos 2001, 3). chappuis-2011, 2.6, leaves
    // it out and loses some 4 %.
    leaving *= (1.0 - mirror_view.x) / (1.0 - mirror_view.y);
    // Uniform light from everywhere is reflected by the directional albedo of the view: reciprocity.
    surface += ambient_mirrored * occlusion * mirror_view.x;
    entering += ambient * occlusion * (1.0 - mirror_view.y);
#else
    // Ambient reflection: what stands in the mirror direction, with Schlick's Fresnel damped by roughness.
    vec3 fresnel_view = f0 + (max(vec3(1.0 - roughness) * f90, f0) - f0) * pow(1.0 - min(n_v, 1.0), 5.0);
#ifdef HAIR
    // A cylinder mirrors all directions across it, and has passed most of what is left through its own colour.
    fresnel_view = 0.046 * sqrt(base.rgb);
#endif
    surface += fresnel_view * ambient_mirrored * occlusion;
    entering += ambient * occlusion;
#endif

#ifdef SHADOWS
    // Vertices are placed to a 256th of a pixel or so: more than a texel of a shadow map where a head is a few pixels.
    float vague = length(fwidth(position_world)) / 128.0;
#endif
    for (int i = 0; i < counts.x; ++i) {
        Light light = lights[i];
        Arriving arrives = arriving(light);
        vec3 l = arrives.direction;
        float n_l = dot(n, l);
#ifdef SHADOWS
        InMap map = in_map(light, vertex_normal);
#endif
#if defined(SKIN) && defined(TRANSLUCENCY)
        entering += arrives.radiance * transmitted(light, map, l, vertex_normal);
#endif
#ifdef HAIR
        if (n_l <= -strands_wrap) continue;
#else
        if (n_l <= 0.0) continue;
#endif
        vec3 radiance = arrives.radiance;
#ifdef SHADOWS
#ifdef HAIR
        // Strands hide a part of the light from each other and send most of it on.
        radiance *= mix(0.3, 1.0, lit_share(light, map, vertex_normal, l, vague));
#elif defined(MOUTH)
        // Wet lips and enamel hand light on: in the shadow of a lip teeth are half as bright, not black. Light from behind
        // has the head before it, and none of it gets there.
        radiance *= mix(0.5 * smoothstep(0.0, 0.5, dot(l, mouth_forward.xyz)), 1.0,
                        lit_share(light, map, vertex_normal, l, vague));
#else
        radiance *= lit_share(light, map, vertex_normal, l, vague);
#endif
#endif
        vec3 h = l + view;
#ifdef HAIR
        vec3 shares = strand_shares(strand, n, l, view);
        entering += radiance * shares.x;
        surface += pi * radiance * (shares.y * exposed + shares.z * sqrt(base.rgb));
#elif defined(SKIN) && defined(SKIN_REFLECTION)
        entering += (1.0 - skin_intensity * specular_albedo(n_l, skin_rough).x) * radiance * n_l;
        // radiance is irradiance / pi: Lambert's 1 / pi cancels, the specular term keeps pi.
        surface += pi * skin_intensity * skin_specular(n, h, view, skin_rough) * radiance * n_l;
#else
        h = unit_or(h, n);
        vec3 fresnel = f0 + (f90 - f0) * pow(1.0 - clamp(dot(view, h), 0.0, 1.0), 5.0);
        float specular = specular_ggx(n_l, n_v, clamp(dot(n, h), 0.0, 1.0), roughness * roughness);
#ifdef EYE
        entering += (1.0 - fresnel) * radiance * max(dot(inner, l), 0.0) * lids;
#else
        entering += (1.0 - fresnel) * radiance * n_l;
#endif
        surface += pi * specular * fresnel * radiance * n_l;
#endif
    }
#ifdef MOUTH
    float inside = mouth_visibility(position_world);
    entering *= inside;
    surface *= inside;
#endif
    vec3 emitted = emissive_linear.rgb;
#ifdef EMISSIVE_MAP
    emitted *= texture(emissive_map, texture_uv[4]).rgb;
#endif
    surface += emitted;

    float opacity = max(base.a, alpha.y);
#if defined(SCATTER) && defined(SKIN)
    // chappuis-2011, 2.2.4: a part of the albedo before the diffusion, the rest after it.
    vec3 albedo = max(diffuse_color, vec3(1e-6));
    vec3 before = pow(albedo, vec3(skin.y));
    skin_light = vec4(min(entering * before, vec3(largest_radiance)), 1.0);
    skin_albedo = vec4(albedo / before * leaving, scatter_strength);
    skin_depth_mm = vec4(dot(depth_from_world, vec4(position_world, 1.0)) * skin.x, 0.0, 0.0, 1.0);
#else
    surface += diffuse_color * entering * leaving;
#if defined(SCATTER)
    skin_light = skin_albedo = skin_depth_mm = vec4(0.0, 0.0, 0.0, opacity);
    if (alpha.y == 1.0) skin_light = skin_albedo = skin_depth_mm = vec4(0.0);
#endif
#endif
    radiance_linear = vec4(min(surface, vec3(largest_radiance)), opacity);
}
