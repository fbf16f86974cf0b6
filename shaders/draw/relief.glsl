// The fine shape that maps give a surface, before it bends the vertex normal.

// A struct, so that what else filtering knows of a relief (the second moments of its slopes, as LEAN mapping keeps them)
// has a place beside its mean.
struct Relief {
    vec3 normal;  // in tangent space, of any length
    bool bent;    // false leaves the vertex normal as it is, to the bit
};

vec3 bent_normal(vec3 n, vec4 tangent, Relief relief) {
    vec3 t = tangent.xyz - n * dot(n, tangent.xyz);
    if (!relief.bent || !(dot(t, t) > 1e-30)) return n;
    t = unit_or(t, vec3(1.0, 0.0, 0.0));
    vec3 b = cross(n, t) * tangent.w;
    return unit_or(t * relief.normal.x + b * relief.normal.y + n * relief.normal.z, n);
}
