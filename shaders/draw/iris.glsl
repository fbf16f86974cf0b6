// The iris behind the cornea.

// How much of the cornea stands over the iris here: 1 in its middle, 0 from the limbus on, half an angle of 30 degrees
// (a radius of 6 mm on an eyeball of 12).
float over_iris(Eye eye, vec3 place) {
    return eye.index < 0 ? 0.0 : smoothstep(0.860, 0.915, dot(unit_or(place - eye.centre, eye.axis), eye.axis));
}

// Where in the texture of the eyeball the iris is seen: the ray is bent at the cornea (1.336, the aqueous humour's index)
// and meets the plane of the iris, which stands behind the limbus. A texture is painted as if it lay on the surface, so
// that the offset on the plane is taken to texture coordinates by the derivatives of both.
vec2 iris_offset(Eye eye, Interpolants at) {
    if (eye.index < 0 || parts.iris_depth == 0.0) return vec2(0.0);
    vec3 place = at.position_world, px = at.position_dx, py = at.position_dy;
    vec3 view = towards_camera(place);
    vec3 inward = refract(-view, unit_or(at.normal_world, view), 1.0 / 1.336);
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
    return parts.iris_depth * over_iris(eye, place) * (pixels.x * at.texture_uv[0].dx + pixels.y * at.texture_uv[0].dy);
}

// The iris is a shallow bowl: light from one side brightens the other.
vec3 iris_normal(Eye eye, Surface s) {
    if (eye.index < 0) return s.normal;
    vec3 bowl = eye.axis - 0.7 * (s.normal - eye.axis * dot(s.normal, eye.axis));
    return unit_or(mix(s.normal, bowl, over_iris(eye, s.position)), s.normal);
}
