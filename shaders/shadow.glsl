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
    vec2 at = shadow_texel(i, place.xy) - 0.5;
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
    return sum / 9.0;
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
