// What the diffusion on the screen reads: light that enters the skin, the albedo that it meets when it leaves, and depth,
// each times the matte (how much of the pixel is skin). What is not skin writes 0, and by blending takes its own share from
// the skin behind.

layout(location = SCATTERING_OUTPUT) out vec4 skin_light;
layout(location = SCATTERING_OUTPUT + 1) out vec4 skin_albedo;
layout(location = SCATTERING_OUTPUT + 2) out vec4 skin_depth_mm;

void write_skin(Surface s, Lighting lit) {
    // chappuis-2011, 2.2.4: a part of the albedo before the diffusion, the rest after it.
    vec3 albedo = max(diffuse_color(s), vec3(1e-6));
    vec3 before = pow(albedo, vec3(scattering.albedo_before));
    skin_light = vec4(min(lit.entering * before, vec3(largest_radiance)), 1.0);
    skin_albedo = vec4(albedo / before * lit.leaving, s.scatter);
    skin_depth_mm = vec4(dot(depth_from_world, vec4(s.position, 1.0)) * millimetres_a_unit, float(counts.y), 0.0, 1.0);
}

void write_no_skin(float opacity) {
    skin_light = skin_albedo = skin_depth_mm = vec4(0.0, 0.0, 0.0, opacity);
    if (alpha.y == 1.0) skin_light = skin_albedo = skin_depth_mm = vec4(0.0);
}

// What enters the skin wanders on the screen: the diffusion adds what leaves.
void scattering_output(Surface s, Lighting lit, float opacity, inout vec3 inside) {
    if (s.model == model_skin) {
        write_skin(s, lit);
        inside = vec3(0.0);
    } else {
        write_no_skin(opacity);
    }
}
