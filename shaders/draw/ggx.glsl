// A surface over a Lambert inside: Trowbridge-Reitz with Schlick's Fresnel term (glTF 2.0, appendix B).

struct Gloss {
    vec3 f0, f90;  // reflectance at normal incidence and where light grazes
    float roughness;
};

Gloss gloss_of(Surface s) {
    return Gloss(mix(vec3(0.04 * s.specular), s.base_color, s.metallic), vec3(mix(s.specular, 1.0, s.metallic)),
                 s.roughness);
}

// Distribution over 4 (n.l)(n.v), with the height-correlated Smith visibility (Heitz 2014).
float specular_ggx(float n_l, float n_v, float n_h, float ggx_alpha) {
    float a2 = ggx_alpha * ggx_alpha;
    float d = n_h * n_h * (a2 - 1.0) + 1.0;
    float distribution = a2 / (pi * d * d);
    float visibility = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2));
    return distribution * visibility;
}

Split ggx_split(Surface s, Gloss gloss, vec3 view, vec3 l) {
    vec3 h = unit_or(l + view, s.normal);
    vec3 fresnel = gloss.f0 + (gloss.f90 - gloss.f0) * pow(1.0 - clamp(dot(view, h), 0.0, 1.0), 5.0);
    float specular = specular_ggx(dot(s.normal, l), cosine_to_view(s, view), clamp(dot(s.normal, h), 0.0, 1.0),
                                  gloss.roughness * gloss.roughness);
    // Radiance of white is irradiance / pi: Lambert's 1 / pi cancels, the specular term keeps pi.
    return Split(1.0 - fresnel, pi * specular * fresnel);
}

// Of light from all around: what stands in the mirror's direction, with a Fresnel term damped by roughness.
Lighting ggx_around(Surface s, Gloss gloss, vec3 view, Ambient around) {
    vec3 fresnel = gloss.f0 + (max(vec3(1.0 - gloss.roughness) * gloss.f90, gloss.f0) - gloss.f0) *
                                  pow(1.0 - min(cosine_to_view(s, view), 1.0), 5.0);
    return Lighting(around.white * s.occlusion, fresnel * around.mirrored * s.occlusion, vec3(1.0));
}
