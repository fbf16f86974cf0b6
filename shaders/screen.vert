// One triangle that covers the screen.
out vec2 screen_uv;

void main() {
    screen_uv = vec2(float((gl_VertexID & 1) << 2) * 0.5, float((gl_VertexID & 2) << 1) * 0.5);
    gl_Position = vec4(screen_uv * 2.0 - 1.0, 0.0, 1.0);
}
