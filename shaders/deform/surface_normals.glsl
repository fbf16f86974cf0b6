// The shader's twin of rig/deform/surface_normals.cpp: the same operations in the same order, every one `precise`, so that no
// fused multiply-add and no reassociation makes the bits differ. The limits are explained there.

bool has_direction(float length2) { return length2 > 1e-30 && length2 < 1e37; }

float dot3(vec3 a, vec3 b) {
    precise float d = a.x * b.x + a.y * b.y + a.z * b.z;
    return d;
}

vec3 cross3(vec3 a, vec3 b) {
    precise vec3 c = vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    return c;
}

vec3 normalized_or(vec3 v, vec3 fallback) {
    float length2 = dot3(v, v);
    if (!has_direction(length2)) return fallback;
    precise float inverse_length = 1.0 / sqrt(length2);
    precise vec3 n = v * inverse_length;
    return n;
}

float angle_of(float sine, float cosine) {
    float size = abs(cosine);
    bool steep = sine > size;
    precise float ratio = steep ? size * (1.0 / sine) : sine * (1.0 / size);
    precise float t2 = ratio * ratio;
    precise float angle =
        ratio * (0.9998660 + t2 * (-0.3302995 + t2 * (0.1801410 + t2 * (-0.0851330 + t2 * 0.0208351))));
    if (steep) angle = 1.57079633 - angle;
    return cosine < 0.0 ? 3.14159265 - angle : angle;
}

vec3 angle_times_normal(vec3 edge, vec3 other_edge) {
    vec3 u = normalized_or(edge, vec3(0.0));
    vec3 v = normalized_or(other_edge, vec3(0.0));
    vec3 normal = cross3(u, v);
    float sine2 = dot3(normal, normal);
    if (!(sine2 > 1e-30)) return vec3(0.0);
    precise float sine = sqrt(sine2);
    precise float weight = angle_of(sine, dot3(u, v)) * (1.0 / sine);
    precise vec3 weighted = normal * weight;
    return weighted;
}

vec3 turned_normal(vec3 rest_normal, vec3 rest_sum, vec3 deformed_sum) {
    if (rest_sum == deformed_sum) return rest_normal;
    if (!(dot3(rest_sum, rest_sum) > 1e-6 && dot3(deformed_sum, deformed_sum) > 1e-6)) return rest_normal;
    vec3 from = normalized_or(rest_sum, vec3(0.0));
    vec3 to = normalized_or(deformed_sum, vec3(0.0));
    if (from == vec3(0.0) || to == vec3(0.0)) return rest_normal;
    float c = dot3(from, to);
    precise float one_plus_c = 1.0 + c;
    if (one_plus_c < 1.5e-6) return to;
    vec3 v = cross3(from, to);
    precise float inverse = 1.0 / one_plus_c;
    precise float along = dot3(v, rest_normal) * inverse;
    precise vec3 turned = c * rest_normal + cross3(v, rest_normal) + along * v;
    return normalized_or(turned, rest_normal);
}

vec4 orthogonal_tangent(vec4 tangent, vec3 normal, vec4 rest_tangent) {
    precise vec3 t = tangent.xyz - normal * dot3(normal, tangent.xyz);
    return vec4(normalized_or(t, rest_tangent.xyz), tangent.w);
}
