// Constants and vectors that every shading needs.

const float pi = 3.14159265358979;

vec3 unit_or(vec3 v, vec3 fallback) {
    float length2 = dot(v, v);
    return length2 > 1e-30 && length2 < 1e37 ? v * inversesqrt(length2) : fallback;
}
