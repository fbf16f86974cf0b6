// Shadow maps: all lights' maps stand side by side in one depth texture. Percentage-closer filtering of 3 x 3 texels
// with bilinear weights (chappuis-2011, 2.4, filters 4 x 4 at equal weights, which steps where it crosses a texel).
// Twin: the tests' own ray caster.

layout(binding = BLUSH_SHADOW_UNIT) uniform sampler2D shadow_map;

// Distance along the light's axis of a depth in a map, world units.
float shadow_distance(int i, float z) {
    float near = lights[i].shadow_depth.x, far = lights[i].shadow_depth.y;
    return lights[i].shadow.w != 0.0 ? near * far / (far - z * (far - near)) : near + z * (far - near);
}

// xy: place in the light's map, 0 to 1; z: its depth there. w: 0 outside of the map.
vec4 shadow_place(int i, vec3 place_world) {
    vec4 clip = lights[i].shadow_from_world * vec4(place_world, 1.0);
    if (!(clip.w > 0.0)) return vec4(0.0);
    vec3 unit = clip.xyz / clip.w * 0.5 + 0.5;
    bool inside = all(greaterThanEqual(unit, vec3(0.0))) && all(lessThanEqual(unit, vec3(1.0)));
    return vec4(unit, inside ? 1.0 : 0.0);
}

vec2 shadow_texel(int i, vec2 place) {
    float side = float(textureSize(shadow_map, 0).y);
    // The outermost texels are nobody's neighbours in another light's map.
    return vec2(lights[i].shadow.x * side, 0.0) + clamp(place * side, vec2(2.0), vec2(side - 2.0));
}

vec4 shadow_distances(int i, vec4 z) {
    float near = lights[i].shadow_depth.x, far = lights[i].shadow_depth.y;
    return lights[i].shadow.w != 0.0 ? near * far / (far - z * (far - near)) : near + z * (far - near);
}

// Share of 2 x 2 texels around a place (texels) that light gets beyond `distance_here` in, with bilinear weights.
float lit_texels(int i, vec2 at, float distance_here, vec2 texel_uv) {
    vec2 part = fract(at - 0.5);
    // Order of a gather: (0, 1), (1, 1), (1, 0), (0, 0).
    vec4 z = textureGather(shadow_map, (floor(at - 0.5) + 1.0) * texel_uv);
    vec4 lit = step(vec4(distance_here), shadow_distances(i, z));
    return mix(mix(lit.w, lit.z, part.x), mix(lit.x, lit.y, part.x), part.y);
}

// A light that is seen under an angle (Fernando 2005: percentage-closer soft shadows): the mean distance of what hides
// it says how wide the shadow's edge is here. Wide filters follow the surface's own plane, or it would hide itself.
// `sharp`: what the light of no size gives.
float soft_share(int i, vec2 at, float distance_here, float texel, vec3 normal, vec3 l, float sharp) {
    float side = float(textureSize(shadow_map, 0).y), left = lights[i].shadow.x * side;
    vec2 low = vec2(left + 1.5, 1.5), high = vec2(left + side - 1.5, side - 1.5);
    vec2 texel_uv = 1.0 / vec2(textureSize(shadow_map, 0));
    mat4 m = lights[i].shadow_from_world;
    vec3 right = normalize(vec3(m[0].x, m[1].x, m[2].x)), up = normalize(vec3(m[0].y, m[1].y, m[2].y));
    float n_l = max(dot(normal, l), 0.02);
    vec2 slope = texel * vec2(dot(normal, right), dot(normal, up)) / n_l;
    float near = lights[i].shadow_depth.x, size = lights[i].shadow_depth.z;
    bool perspective = lights[i].shadow.w != 0.0;
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
        float blocker = shadow_distance(i, texture(shadow_map, clamp(at + offset, low, high) * texel_uv).r);
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
        sum += lit_texels(i, clamp(at + offset, low, high), distance_here + dot(slope, offset), texel_uv);
    }
    return sum / float(filter_taps);
}

float lit_share(int i, vec3 vertex_normal, vec3 l) {
    if (lights[i].shadow.x < 0.0) return 1.0;
    // Off the surface along its normal by the width of the filter as the surface sees it: no freckles where light
    // grazes, and no gap where it does not. A texel is wider farther from a light with a perspective.
    float texel = lights[i].shadow.z;
    if (lights[i].shadow.w != 0.0) texel *= distance(position_world, lights[i].position_world.xyz);
    float n_l = clamp(dot(vertex_normal, l), 0.0, 1.0);
    vec3 off = position_world + vertex_normal * texel * (0.5 + 2.0 * sqrt(1.0 - n_l * n_l));
    vec4 place = shadow_place(i, off);
    if (place.w == 0.0) return 1.0;
    // The surface's own depth less a texel, as the map stores it.
    float near = lights[i].shadow_depth.x, far = lights[i].shadow_depth.y;
    float distance_here = shadow_distance(i, place.z) - texel;
    float here = lights[i].shadow.w != 0.0 ? far * (distance_here - near) / (max(distance_here, 1e-9) * (far - near))
                                           : (distance_here - near) / (far - near);
    vec2 middle = shadow_texel(i, place.xy);
    vec2 at = middle - 0.5;
    vec2 part = fract(at);
    // 4 x 4 texels by four gathers; the outer rows and columns count in part.
    vec2 texel_uv = 1.0 / vec2(textureSize(shadow_map, 0));
    vec2 corner = floor(at);
    vec4 weight_x = vec4(1.0 - part.x, 1.0, 1.0, part.x), weight_y = vec4(1.0 - part.y, 1.0, 1.0, part.y);
    float sum = 0.0;
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 2; ++x) {
            // Order of a gather: (0, 1), (1, 1), (1, 0), (0, 0).
            vec4 lit = step(vec4(here), textureGather(shadow_map, (corner + vec2(2 * x, 2 * y)) * texel_uv));
            vec2 wx = x == 0 ? weight_x.xy : weight_x.zw, wy = y == 0 ? weight_y.xy : weight_y.zw;
            sum += wy.y * (wx.x * lit.x + wx.y * lit.y) + wy.x * (wx.y * lit.z + wx.x * lit.w);
        }
    }
    if (lights[i].shadow_depth.z == 0.0) return sum / 9.0;
    return soft_share(i, middle, distance_here, texel, vertex_normal, l, sum / 9.0);
}

// How far the light came inside, world units, at most `most`; of a point that stands a little below the surface. Where
// the map is empty the light met no outside of the surface: none came inside.
float depth_inside(int i, vec3 place_world, float most) {
    vec4 place = shadow_place(i, place_world);
    if (place.w == 0.0) return most;
    vec2 at = shadow_texel(i, place.xy) - 0.5;
    vec2 part = fract(at);
    ivec2 corner = ivec2(floor(at));
    float here = shadow_distance(i, place.z);
    float inside = 0.0;
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 2; ++x) {
            float z = texelFetch(shadow_map, corner + ivec2(x, y), 0).r;
            float depth = z < 1.0 ? clamp(here - shadow_distance(i, z), 0.0, most) : most;
            inside += (x == 0 ? 1.0 - part.x : part.x) * (y == 0 ? 1.0 - part.y : part.y) * depth;
        }
    }
    return inside;
}
