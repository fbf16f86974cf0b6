// Where an eyeball stands and where it looks, after the deformation.

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
    eye.index = parts.eyes_known == 0 ? -1 : distance(place, parts.eyes[0].xyz) <= distance(place, parts.eyes[1].xyz) ? 0 : 1;
    if (eye.index < 0) return eye;
    eye.centre = parts.eyes[eye.index].xyz;
    eye.radius = parts.eyes[eye.index].w;
    vec3 pole = (world_from_mesh * vec4(surface_position(eye.index == 0 ? parts.first_pole : parts.second_pole), 1.0)).xyz;
    eye.axis = unit_or(pole - eye.centre, vec3(0.0, 0.0, 1.0));
    return eye;
}
