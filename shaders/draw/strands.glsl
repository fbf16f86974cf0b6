// Strands run along the texture's v. Diffuse light of a thin cylinder (Kajiya and Kay 1989); its two highlights:
// reflected at the scales of the cuticle, which stand off towards the root, and, with the hair's colour, at the far side
// of the strand (after Marschner et al. 2003).
vec3 strand_direction(Interpolants at, vec3 n) {
    vec3 px = at.position_dx, py = at.position_dy;
    vec2 ux = at.texture_uv[0].dx, uy = at.texture_uv[0].dy;
    // With (a, b) so that a ux + b uy = (0, 1): a px + b py runs along v.
    float determinant = ux.x * uy.y - ux.y * uy.x;
    vec3 along = (px * -uy.x + py * ux.x) * (determinant < 0.0 ? -1.0 : 1.0);
    along -= n * dot(along, n);
    return unit_or(along, unit_or(cross(n, vec3(1.0, 0.0, 0.0)), vec3(0.0, 1.0, 0.0)));
}

float lobe(float radians, float shift, float width) {
    float x = (radians - shift) / width;
    return exp(-0.5 * x * x) / (width * 2.5066);
}

// Cosine behind the light's horizon to which it comes around strands.
const float strands_wrap = 0.25;

// x: of the diffuse light; yz: of the first and of the coloured highlight, over the light's radiance.
vec3 strand_shares(vec3 strand, vec3 n, vec3 l, vec3 view) {
    float sin_l = clamp(dot(strand, l), -1.0, 1.0), sin_v = clamp(dot(strand, view), -1.0, 1.0);
    float cos_l = sqrt(1.0 - sin_l * sin_l);
    float half_angle = 0.5 * (asin(sin_l) + asin(sin_v));
    vec3 l_across = l - strand * sin_l, v_across = view - strand * sin_v;
    float cos_across = dot(l_across, v_across) * inversesqrt(max(dot(l_across, l_across) * dot(v_across, v_across), 1e-12));
    float forward = sqrt(max(0.5 + 0.5 * cos_across, 0.0));
    float cos_difference = max(cos(0.5 * (asin(sin_l) - asin(sin_v))), 0.2);
    // 1/4 of the light that crosses the strand's width goes each way around it; Fresnel at 1.55 is 0.046.
    float around = 0.25 * forward * cos_l / (cos_difference * cos_difference);
    const float degree = 0.0174533;
    float first = 0.046 * around * lobe(half_angle, -7.5 * degree, 9.0 * degree);
    float second = 0.046 * around * lobe(half_angle, 11.0 * degree, 18.0 * degree);
    // A card stands for strands one behind the other: those turned away from the light are in the shadow of the rest,
    // and of those that shine half are hidden.
    float before_others = clamp((dot(n, l) + strands_wrap) / (1.0 + strands_wrap), 0.0, 1.0);
    return before_others * vec3(cos_l, 0.5 * first * before_others, second);
}
