// Light of a lamp as it arrives at a place, if nothing stands between.

struct Arriving {
    vec3 direction;  // unit, towards the light
    vec3 radiance;   // of a white surface that faces it
};

Arriving arriving(Light light, vec3 position) {
    Arriving result;
    result.direction = light.position_world.xyz;
    result.radiance = light.radiance_linear.rgb;
    if (light.position_world.w != 0.0) {
        vec3 to = light.position_world.xyz - position;
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
