// Light from around as the face itself lets it come to a vertex (chappuis-2011, 3.3). Twin: occluded_ambient() in
// rig/light/occlusion.cpp, which turns coefficients by a 9x9 matrix.

// Three entries a vertex and pose: coefficients 0 to 8 in the vertex's frame, divided by what the cosine's convolution
// has in their band, so that those of an open vertex are the basis functions of its normal.
layout(std430, binding = BLUSH_OCCLUSION_BINDING) readonly buffer OcclusionCoefficients { vec4 transfer[]; };

// Radiance that white reflects, by nine coefficients; sum_of_sh() of a direction's functions.
vec3 gathered(vec4 h0, vec4 h1, float h8) {
    return h0.x * ambient_sh[0].rgb + h0.y * ambient_sh[1].rgb + h0.z * ambient_sh[2].rgb + h0.w * ambient_sh[3].rgb +
           h1.x * ambient_sh[4].rgb + h1.y * ambient_sh[5].rgb + h1.z * ambient_sh[6].rgb + h1.w * ambient_sh[7].rgb +
           h8 * ambient_sh[8].rgb;
}

// rgb: share of the light of an open vertex that arrives here; a: share of the directions that are open.
vec4 ambient_share(vec3 normal, vec3 tangent) {
    vec4 a = vec4(0.0), b = vec4(0.0);
    float c = 0.0;
    for (int pose = 0; pose < occlusion.poses; ++pose) {
        float weight = occlusion.weights[pose >> 2][pose & 3];
        if (weight == 0.0) continue;
        int at = 3 * (pose * occlusion.vertices + gl_VertexID);
        a += weight * transfer[at];
        b += weight * transfer[at + 1];
        c += weight * transfer[at + 2].x;
    }
    // vertex_frame() in rig/light/occlusion.cpp.
    vec3 z = normalize(normal);
    vec3 x = tangent - z * dot(z, tangent);
    if (!(dot(x, x) > 1e-12)) {
        vec3 other = abs(z.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
        x = other - z * dot(z, other);
    }
    x = normalize(x);
    mat3 world = mat3(x, cross(z, x), z);
    // A turn of band 1 (y, z, x) is that of a vector, a turn of band 2 that of a symmetric matrix without a trace: the
    // quadratic form that its five functions are.
    vec3 one = world * vec3(a.w, a.y, a.z);
    const float root3 = 1.73205080757;
    float xx = -b.z / root3 + c, yy = -b.z / root3 - c, zz = 2.0 * b.z / root3;
    mat3 two = world * mat3(xx, b.x, b.w, b.x, yy, b.y, b.w, b.y, zz) * transpose(world);
    vec3 here = gathered(vec4(a.x, one.y, one.z, one.x), vec4(two[0][1], two[1][2], 0.5 * root3 * two[2][2], two[0][2]),
                         0.5 * (two[0][0] - two[1][1]));
    vec3 open = gathered(
        vec4(0.282094792, 0.488602512 * z.y, 0.488602512 * z.z, 0.488602512 * z.x),
        vec4(1.092548431 * z.x * z.y, 1.092548431 * z.y * z.z, 0.315391565 * (3.0 * z.z * z.z - 1.0), 1.092548431 * z.x * z.z),
        0.546274215 * (z.x * z.x - z.y * z.y));
    float directions = clamp(a.x / 0.282094792, 0.0, 1.0);
    // Nine coefficients ring: what an open vertex gathers bounds what arrives from above, what comes from every side
    // from below; where an open vertex gathers nothing, the open directions say how much a neighbour may have.
    vec3 least = directions * vec3(ambient_sh[0].w, ambient_sh[1].w, ambient_sh[2].w);
    vec3 share = vec3(directions);
    for (int i = 0; i < 3; ++i) {
        if (open[i] > 1e-4 * abs(ambient_sh[0][i])) share[i] = clamp(max(here[i], least[i]) / open[i], 0.0, 1.0);
    }
    return vec4(share, directions);
}

void occlusion_visibility(vec3 normal, vec3 tangent, inout vec4 visibility) { visibility = ambient_share(normal, tangent); }
