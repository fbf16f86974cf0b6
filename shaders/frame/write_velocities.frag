// Velocities of what is seen of the characters, into a framebuffer of the host's.
layout(binding = 0) uniform sampler2D velocities;  // shaders/antialias/velocities.frag
layout(location = 0) uniform ivec2 corner;         // of the view in the framebuffer, pixels
layout(location = 0) out vec2 velocity;

void main() {
    vec4 here = texelFetch(velocities, ivec2(gl_FragCoord.xy) - corner, 0);
    if (here.x == 0.0 && here.w == 0.0) discard;  // no character
    velocity = here.yz;
}
