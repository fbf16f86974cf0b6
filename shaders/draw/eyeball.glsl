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
    eye.index = eye_data.x == 0 ? -1 : distance(place, eyes[0].xyz) <= distance(place, eyes[1].xyz) ? 0 : 1;
    if (eye.index < 0) return eye;
    eye.centre = eyes[eye.index].xyz;
    eye.radius = eyes[eye.index].w;
    vec3 pole = (world_from_mesh * vec4(surface_position(eye.index == 0 ? eye_data.y : eye_data.z), 1.0)).xyz;
    eye.axis = unit_or(pole - eye.centre, vec3(0.0, 0.0, 1.0));
    return eye;
}
