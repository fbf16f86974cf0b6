// Light from all around of the probes that a character stands among. ambient_sh holds what white reflects of probes and
// scene together; what a mirror shows of the probes has no more than their nine coefficients.

vec3 probes_mirrored(vec3 direction) {
    vec4 c[9] = probes.radiance_sh;
    return max(sum_of_sh(direction, c), vec3(0.0));
}

void probes_ambient(Surface s, vec3 mirror, inout Ambient around) {
    around.white = max(sum_of_sh(s.normal, ambient_sh), vec3(0.0));
    around.mirrored = (1.0 - probes.share) * around.mirrored + probes_mirrored(mirror);
}
