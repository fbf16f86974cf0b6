// What every deformation pass streams out, and how the last of them ends.

out vec3 deformed_position;
out vec3 deformed_normal;
out vec4 deformed_tangent;

// n, t: the sums so far. Only the last pass normalises; what no target changed keeps its bits.
void finish_deformation(vec3 n, vec4 t, bool last_pass, bool recomputed, vec3 rest_normal, vec4 rest_tangent) {
    if (recomputed) {
        n = rest_normal;
        t = rest_tangent;
    } else if (last_pass) {
        bool turned = n != rest_normal;
        if (turned) n = normalized_or(n, rest_normal);
        if (n != rest_normal || t != rest_tangent) t = orthogonal_tangent(t, n, rest_tangent);
    }
    deformed_normal = n;
    deformed_tangent = t;
}
