// What stands in the host's world between a light and a face, from a shadow map that the host drew.
#include "light/percentage_closer.glsl"

layout(binding = HOST_SHADOWS_UNIT) uniform sampler2D host_shadow_map_0;
#ifdef TWO_HOST_SHADOWS
layout(binding = HOST_SHADOWS_UNIT + 1) uniform sampler2D host_shadow_map_1;
#endif
#ifdef THREE_HOST_SHADOWS
layout(binding = HOST_SHADOWS_UNIT + 2) uniform sampler2D host_shadow_map_2;
#endif
#ifdef FOUR_HOST_SHADOWS
layout(binding = HOST_SHADOWS_UNIT + 3) uniform sampler2D host_shadow_map_3;
#endif

float host_share_of(sampler2D map, int k, Surface s, vec3 l) {
    // As much farther where light grazes as our own maps step (shadow.glsl).
    float n_l = clamp(dot(s.vertex_normal, l), 0.0, 1.0);
    vec4 look_up = host_shadows.look_up[k];
    vec3 place = s.position + s.vertex_normal * (look_up.x * (0.5 + 2.0 * sqrt(1.0 - n_l * n_l)));
    vec4 clip = host_shadows.clip_from_world[k] * vec4(place, 1.0);
    if (!(clip.w > 0.0)) return 1.0;
    vec3 unit = clip.xyz / clip.w;
    vec2 at = unit.xy * 0.5 + 0.5;
    float here = look_up.y != 0.0 ? unit.z : unit.z * 0.5 + 0.5;
    if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0))) || here < 0.0 || here > 1.0) return 1.0;
    return share_beyond(map, at * vec2(textureSize(map, 0)), here, look_up.z != 0.0);
}

// shadow_depth.w: number of the light's map, from 1.
float host_share(Surface s, Light light, vec3 l) {
    switch (int(light.shadow_depth.w)) {
        case 1: return host_share_of(host_shadow_map_0, 0, s, l);
#ifdef TWO_HOST_SHADOWS
        case 2: return host_share_of(host_shadow_map_1, 1, s, l);
#endif
#ifdef THREE_HOST_SHADOWS
        case 3: return host_share_of(host_shadow_map_2, 2, s, l);
#endif
#ifdef FOUR_HOST_SHADOWS
        case 4: return host_share_of(host_shadow_map_3, 3, s, l);
#endif
    }
    return 1.0;
}

void host_shadows_lit(Surface s, Light light, vec3 l, inout float share) {
    if (share > 0.0) share *= host_share(s, light, l);
}

// A light that stands behind an ear and behind a wall does not shine through the ear.
void host_shadows_through(Surface s, Light light, Arriving arrives, inout vec3 entering) {
    if (entering != vec3(0.0)) entering *= host_share(s, light, arrives.direction);
}
