// Parts of a head that are no skin: wet eyes below their lids, the inside of the mouth, strands of hair.

#ifdef EYE
// The surface that the deformation left, three floats a vertex: lids are looked up where they are now.
layout(std430, binding = BLUSH_SURFACE_POSITIONS_BINDING) readonly buffer SurfacePositions { float surface_positions[]; };

vec3 surface_position(int vertex) {
    return vec3(surface_positions[3 * vertex], surface_positions[3 * vertex + 1], surface_positions[3 * vertex + 2]);
}

struct Eye {
    int index;  // below 0: not known where it is
    vec3 centre, axis;
    float radius;
};

Eye eye_here(vec3 place) {
    Eye eye;
    eye.index = eye_data.x == 0 ? -1 : distance(place, eyes[0].xyz) <= distance(place, eyes[1].xyz) ? 0 : 1;
    if (eye.index < 0) return eye;
    eye.centre = eyes[eye.index].xyz;
    eye.radius = eyes[eye.index].w;
    vec3 pole = (world_from_mesh * vec4(surface_position(eye.index == 0 ? eye_data.y : eye_data.z), 1.0)).xyz;
    eye.axis = unit_or(pole - eye.centre, vec3(0.0, 0.0, 1.0));
    return eye;
}

float distance_to_segment(vec3 p, vec3 a, vec3 b) {
    vec3 along = b - a;
    float t = clamp(dot(p - a, along) / max(dot(along, along), 1e-20), 0.0, 1.0);
    return distance(p, a + t * along);
}

// Share of the light that a wall of `height` leaves at a distance from its foot, of a sky as bright everywhere: half of
// the sky is the wall's where they touch (Lambert's form factor of a long wall). Lashes and the lid's own bend hide more
// than half, so that nothing is left there.
float beside_a_wall(float d, float height) { return d * inversesqrt(d * d + height * height + 1e-20); }

// What the lids leave of the light on the eyeball.
float lid_visibility(Eye eye, vec3 place) {
    if (eye.index < 0 || eye_data.w == 0) return 1.0;
    int first = eye.index * 2 * BLUSH_LID_POINTS;
    float nearest[2] = float[2](1e30, 1e30);
    for (int lid = 0; lid < 2; ++lid) {
        vec3 last = vec3(0.0);
        for (int i = 0; i < BLUSH_LID_POINTS; ++i) {
            int at = first + lid * BLUSH_LID_POINTS + i;
            vec3 point = (world_from_lids * vec4(surface_position(lid_points[at / 4][at % 4]), 1.0)).xyz;
            if (i > 0) nearest[lid] = min(nearest[lid], distance_to_segment(place, last, point));
            last = point;
        }
    }
    // Millimetres that the upper lid with its lashes, and the lower one, stand out over the eyeball.
    float upper = beside_a_wall(nearest[0] * skin.x, 2.5), lower = beside_a_wall(nearest[1] * skin.x, 1.0);
    return mix(1.0, upper, parts.x) * mix(1.0, lower, 0.6 * parts.x);
}

// How much of the cornea stands over the iris here: 1 in its middle, 0 from the limbus on, half an angle of 30 degrees
// (a radius of 6 mm on an eyeball of 12).
float over_iris(Eye eye, vec3 place) {
    return eye.index < 0 ? 0.0 : smoothstep(0.860, 0.915, dot(unit_or(place - eye.centre, eye.axis), eye.axis));
}

// Where in the texture of the eyeball the iris is seen: the ray is bent at the cornea (1.336, the aqueous humour's index)
// and meets the plane of the iris, which stands behind the limbus. A texture is painted as if it lay on the surface, so
// that the offset on the plane is taken to texture coordinates by the derivatives of both.
vec2 iris_offset(Eye eye, vec3 place, vec3 n, vec3 view, vec2 uv) {
    vec3 px = dFdx(place), py = dFdy(place);
    vec2 ux = dFdx(uv), uy = dFdy(uv);
    if (eye.index < 0 || parts.y == 0.0) return vec2(0.0);
    float share = over_iris(eye, place);
    vec3 inward = refract(-view, n, 1.0 / 1.336);
    float sinks = max(-dot(inward, eye.axis), 0.2);
    float above = max(dot(place - eye.centre, eye.axis) - 0.866 * eye.radius, 0.0);
    vec3 offset = inward * (above / sinks);
    offset -= eye.axis * dot(offset, eye.axis);
    px -= eye.axis * dot(px, eye.axis);
    py -= eye.axis * dot(py, eye.axis);
    float xx = dot(px, px), xy = dot(px, py), yy = dot(py, py), x = dot(px, offset), y = dot(py, offset);
    float determinant = xx * yy - xy * xy;
    if (!(determinant > 1e-4 * xx * yy)) return vec2(0.0);
    vec2 pixels = vec2(x * yy - y * xy, y * xx - x * xy) / determinant;
    return parts.y * share * (pixels.x * ux + pixels.y * uy);
}
#endif

#ifdef MOUTH
// What is left of the light behind the lips: it falls with the depth behind the foremost tooth by how much of an opening
// 50 mm wide is seen from there, 1 / (1 + (d / r)^2) of a disc's. Occlusion and shadows do the rest.
float mouth_visibility(vec3 place) {
    float depth_mm = max(dot(mouth_front.xyz - place, mouth_forward.xyz) * skin.x, 0.0);
    return mix(1.0, 1.0 / (1.0 + depth_mm * depth_mm / (25.0 * 25.0)), parts.z);
}
#endif

#ifdef HAIR
// Strands run along the texture's v. Diffuse light of a thin cylinder (Kajiya and Kay 1989); its two highlights:
// reflected at the scales of the cuticle, which stand off towards the root, and, with the hair's colour, at the far side
// of the strand (after Marschner et al. 2003).
vec3 strand_direction(vec3 place, vec2 uv, vec3 n) {
    vec3 px = dFdx(place), py = dFdy(place);
    vec2 ux = dFdx(uv), uy = dFdy(uv);
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
#endif
