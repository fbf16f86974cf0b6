// Shadow maps: the maps of all lights and characters are tiles of one depth texture. Percentage-closer filtering of 3 x 3 texels
// with bilinear weights (chappuis-2011, 2.4, filters 4 x 4 at equal weights, which steps where it crosses a texel).
// Twin: the tests' own ray caster.

#include "light/percentage_closer.glsl"

layout(binding = SHADOWS_UNIT) uniform sampler2D shadow_map;

// Distances along the light's axis of depths in its map, world units.
vec4 shadow_distances(Light light, vec4 z) {
    float near = light.shadow_depth.x, far = light.shadow_depth.y;
    return light.shadow.w != 0.0 ? near * far / (far - z * (far - near)) : near + z * (far - near);
}

float shadow_distance(Light light, float z) { return shadow_distances(light, vec4(z)).x; }

// A place of the surface in a light's map, and how it moves with a step along the vertex normal: shadows are looked up
// a little above the surface, thickness a little below.
struct InMap {
    vec4 here, along_normal;  // clip space of the map; along_normal: of one world unit
};

InMap in_map(Light light, Surface s) {
    return InMap(light.shadow_from_world * vec4(s.position, 1.0), light.shadow_from_world * vec4(s.vertex_normal, 0.0));
}

// xy: place in the light's map, 0 to 1; z: its depth there. w: 0 outside of the map.
vec4 shadow_place(vec4 clip) {
    if (!(clip.w > 0.0)) return vec4(0.0);
    vec3 unit = clip.xyz / clip.w * 0.5 + 0.5;
    bool inside = all(greaterThanEqual(unit, vec3(0.0))) && all(lessThanEqual(unit, vec3(1.0)));
    return vec4(unit, inside ? 1.0 : 0.0);
}

vec2 shadow_texel(Light light, vec2 place) {
    float side = light.shadow_tile.z;
    // The outermost texels are nobody's neighbours in another light's map.
    return light.shadow_tile.xy + clamp(place * side, vec2(2.0), vec2(side - 2.0));
}

// Share of 2 x 2 texels around a place (texels) that light gets beyond `distance_here` in, with bilinear weights.
float lit_texels(Light light, vec2 at, float distance_here, vec2 texel_uv) {
    vec2 part = fract(at - 0.5);
    // Order of a gather: (0, 1), (1, 1), (1, 0), (0, 0).
    vec4 z = textureGather(shadow_map, (floor(at - 0.5) + 1.0) * texel_uv);
    vec4 lit = step(vec4(distance_here), shadow_distances(light, z));
    return mix(mix(lit.w, lit.z, part.x), mix(lit.x, lit.y, part.x), part.y);
}

// A light that is seen under an angle (Fernando 2005: percentage-closer soft shadows): the mean distance of what hides
// it says how wide the shadow's edge is here. Wide filters follow the surface's own plane, or it would hide itself.
// `sharp`: what the light of no size gives.
float soft_share(Light light, vec2 at, float distance_here, float texel, vec3 normal, vec3 l, float sharp) {
    vec2 low = light.shadow_tile.xy + 1.5, high = light.shadow_tile.xy + (light.shadow_tile.z - 1.5);
    vec2 texel_uv = 1.0 / vec2(textureSize(shadow_map, 0));
    mat4 m = light.shadow_from_world;
    vec3 right = normalize(vec3(m[0].x, m[1].x, m[2].x)), up = normalize(vec3(m[0].y, m[1].y, m[2].y));
    float n_l = max(dot(normal, l), 0.02);
    vec2 slope = texel * vec2(dot(normal, right), dot(normal, up)) / n_l;
    float near = light.shadow_depth.x, size = light.shadow_depth.z;
    bool perspective = light.shadow.w != 0.0;
    // What may hide some of the light stands nearer to it, as near as the map begins. An edge wider than a few dozen
    // texels would show its taps; where light grazes, a wide filter on the surface's plane would reach over what hides it.
    float widest_texels = min(24.0, 40.0 * n_l);
    float search = perspective ? size * (distance_here - near) / near : size * (distance_here - near);
    search = min(search / texel, widest_texels);
    const int taps = 16;
    const float golden_angle = 2.39996323;
    float blockers = 0.0, count = 0.0;
    for (int k = 0; k < taps; ++k) {
        float angle = golden_angle * float(k);
        vec2 offset = search * sqrt((float(k) + 0.5) / float(taps)) * vec2(cos(angle), sin(angle));
        float blocker = shadow_distance(light, texture(shadow_map, clamp(at + offset, low, high) * texel_uv).r);
        if (blocker < distance_here + dot(slope, offset) - length(offset) * texel) {
            blockers += blocker;
            count += 1.0;
        }
    }
    if (count == 0.0 || count == float(taps)) return sharp;
    float blocker = blockers / count;
    float width = size * (distance_here - blocker) / (perspective ? max(blocker, 1e-9) : 1.0);
    width = min(width / texel, widest_texels);
    if (width < 1.5) return sharp;
    float sum = 0.0;
    const int filter_taps = 32;
    for (int k = 0; k < filter_taps; ++k) {
        float angle = golden_angle * float(k);
        vec2 offset = width * sqrt((float(k) + 0.5) / float(filter_taps)) * vec2(cos(angle), sin(angle));
        sum += lit_texels(light, clamp(at + offset, low, high), distance_here + dot(slope, offset), texel_uv);
    }
    return sum / float(filter_taps);
}

float lit_share(Light light, InMap map, Surface s, vec3 l) {
    if (light.shadow.x < 0.0) return 1.0;
    // Off the surface along its normal by the width of the filter as the surface sees it: no freckles where light
    // grazes, and no gap where it does not. A texel is wider farther from a light with a perspective.
    float texel = light.shadow.z;
    if (light.shadow.w != 0.0) texel *= distance(s.position, light.position_world.xyz);
    // Vertices are placed to a 256th of a pixel or so: more than a texel of a map where a head is a few pixels.
    float bias = max(texel, s.footprint / 128.0);
    float n_l = clamp(dot(s.vertex_normal, l), 0.0, 1.0);
    vec4 place = shadow_place(map.here + map.along_normal * (bias * (0.5 + 2.0 * sqrt(1.0 - n_l * n_l))));
    if (place.w == 0.0) return 1.0;
    // The surface's own depth less the bias, as the map stores it.
    float near = light.shadow_depth.x, far = light.shadow_depth.y;
    float distance_here = shadow_distance(light, place.z) - bias;
    float here = light.shadow.w != 0.0 ? far * (distance_here - near) / (max(distance_here, 1e-9) * (far - near))
                                           : (distance_here - near) / (far - near);
    vec2 middle = shadow_texel(light, place.xy);
    // What strands hide from each other is as broken up as they are: no soft edge shows.
    if (s.model == model_hair) return lit_texels(light, middle, distance_here, 1.0 / vec2(textureSize(shadow_map, 0)));
    float sharp = share_beyond(shadow_map, middle, here, false);
    if (light.shadow_depth.z == 0.0) return sharp;
    return soft_share(light, middle, distance_here, texel, s.vertex_normal, l, sharp);
}

void shadows_lit(Surface s, Light light, vec3 l, inout float share) { share *= lit_share(light, in_map(light, s), s, l); }

// How far the light came inside, world units, at most `most`; of a point that stands a little below the surface. Where
// the map is empty the light met no outside of the surface: none came inside.
float depth_inside(Light light, vec4 clip, float most) {
    vec4 place = shadow_place(clip);
    if (place.w == 0.0) return most;
    vec2 at = shadow_texel(light, place.xy);
    vec2 part = fract(at - 0.5);
    float here = shadow_distance(light, place.z);
    // Order of a gather: (0, 1), (1, 1), (1, 0), (0, 0).
    vec4 z = textureGather(shadow_map, (floor(at - 0.5) + 1.0) / vec2(textureSize(shadow_map, 0)));
    vec4 depth = mix(clamp(here - shadow_distances(light, z), 0.0, most), vec4(most), equal(z, vec4(1.0)));
    return mix(mix(depth.w, depth.z, part.x), mix(depth.x, depth.y, part.x), part.y);
}
