#include "room.h"

#include <cstdio>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>

namespace room {
namespace {

constexpr const char* vertex_text = R"(#version 450 core
layout(location = 0) uniform mat4 clip_from_world;
layout(location = 1) uniform vec3 low;
layout(location = 2) uniform vec3 high;
out vec3 position;
out vec3 normal;
// A box of twelve triangles, from the number of the vertex.
void main() {
    int face = gl_VertexID / 6, corner = gl_VertexID % 6;
    int axis = face / 2;
    float side = float(face % 2);
    vec2 uv = vec2[6](vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 0), vec2(1, 1), vec2(0, 1))[corner];
    vec3 unit;
    unit[axis] = side;
    unit[(axis + 1) % 3] = uv.x;
    unit[(axis + 2) % 3] = uv.y;
    normal = vec3(0.0);
    normal[axis] = 2.0 * side - 1.0;
    position = mix(low, high, unit);
    gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

constexpr const char* depth_text = "#version 450 core\nvoid main() {}\n";

constexpr const char* fragment_text = R"(#version 450 core
layout(location = 3) uniform vec3 colour;
layout(location = 4) uniform uint id;
layout(location = 5) uniform mat4 shadow_from_world;
layout(location = 6) uniform vec3 lamp_position;
layout(location = 7) uniform vec3 lamp_towards;
layout(location = 8) uniform vec4 lamp_radiance;  // w: square of the distance at which it has it
layout(location = 9) uniform float lamp_outer_cosine;
layout(binding = 0) uniform sampler2DShadow shadow_map;
in vec3 position;
in vec3 normal;
layout(location = 0) out vec4 shown;
layout(location = 1) out uint shown_id;
void main() {
    vec3 to = lamp_position - position;
    vec3 l = normalize(to);
    vec4 clip = shadow_from_world * vec4(position + 0.004 * normal, 1.0);
    vec3 at = clip.xyz / clip.w;
    float lit = clip.w > 0.0 ? texture(shadow_map, vec3(at.xy * 0.5 + 0.5, at.z)) : 1.0;
    lit *= smoothstep(lamp_outer_cosine, lamp_outer_cosine + 0.05, dot(-l, normalize(lamp_towards)));
    vec3 radiance = lamp_radiance.rgb * lamp_radiance.w / dot(to, to) * lit * max(dot(normal, l), 0.0);
    vec3 linear = colour * (radiance + 0.06);
    shown = vec4(pow(min(linear, vec3(1.0)), vec3(1.0 / 2.2)), 1.0);
    shown_id = id;
}
)";

GLuint compiled(GLenum stage, const char* text) {
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE) return shader;
    std::array<char, 2048> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    std::fprintf(stderr, "room: %s\n", log.data());
    std::exit(1);
}

GLuint linked(const char* vertex, const char* fragment) {
    const GLuint program = glCreateProgram();
    glAttachShader(program, compiled(GL_VERTEX_SHADER, vertex));
    glAttachShader(program, compiled(GL_FRAGMENT_SHADER, fragment));
    glLinkProgram(program);
    return program;
}

GLuint make_texture(GLenum format, std::uint32_t w, std::uint32_t h) {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    glTextureStorage2D(name, 1, format, static_cast<GLsizei>(w), static_cast<GLsizei>(h));
    return name;
}

}  // namespace

Target::Target() {
    glCreateFramebuffers(1, &framebuffer_);
    colour_ = make_texture(GL_RGBA8, width, height);
    ids_ = make_texture(GL_R32UI, width, height);
    depth_ = make_texture(GL_DEPTH24_STENCIL8, width, height);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, colour_, 0);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT1, ids_, 0);
    glNamedFramebufferTexture(framebuffer_, GL_DEPTH_STENCIL_ATTACHMENT, depth_, 0);
    constexpr std::array<GLenum, 2> both = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(framebuffer_, 2, both.data());
}

void Target::clear() const {
    constexpr std::array<float, 4> black = {0, 0, 0, 1};
    constexpr std::array<GLuint, 4> nothing = {0, 0, 0, 0};
    glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, black.data());
    glClearNamedFramebufferuiv(framebuffer_, GL_COLOR, 1, nothing.data());
    glClearNamedFramebufferfi(framebuffer_, GL_DEPTH_STENCIL, 0, 1, 0);
}

std::vector<std::uint8_t> Target::colour() const {
    std::vector<std::uint8_t> bytes(std::size_t{4} * width * height);
    glGetTextureImage(colour_, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(bytes.size()), bytes.data());
    return bytes;
}

std::vector<std::uint32_t> Target::ids() const {
    std::vector<std::uint32_t> values(std::size_t{width} * height);
    glGetTextureImage(ids_, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, static_cast<GLsizei>(4 * values.size()), values.data());
    return values;
}

ShadowMap::ShadowMap() {
    depth_ = make_texture(GL_DEPTH_COMPONENT24, map_side, map_side);
    glTextureParameteri(depth_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(depth_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
    glNamedFramebufferDrawBuffer(framebuffer_, GL_NONE);
}

void ShadowMap::clear() const {
    const float far_depth = 1;
    glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &far_depth);
}

void ShadowMap::copy_from(const ShadowMap& other) const {
    glCopyImageSubData(other.depth_, GL_TEXTURE_2D, 0, 0, 0, 0, depth_, GL_TEXTURE_2D, 0, 0, 0, 0, map_side, map_side,
                       1);
}

glm::dmat4 Lamp::clip_from_world() const {
    return glm::perspectiveRH_ZO(2.0 * static_cast<double>(outer_radians), 1.0, 0.3, 12.0) *
           glm::lookAtRH(position, position + towards, glm::dvec3(0, 1, 0));
}

Renderer::Renderer() : depth_program_(linked(vertex_text, depth_text)), program_(linked(vertex_text, fragment_text)) {
    glCreateVertexArrays(1, &vertex_array_);
}

void Renderer::draw_boxes(const std::vector<Box>& boxes, GLuint program) const {
    glBindVertexArray(vertex_array_);
    glEnable(GL_DEPTH_TEST);
    for (const Box& box : boxes) {
        glUniform3fv(1, 1, &box.low.x);
        glUniform3fv(2, 1, &box.high.x);
        if (program == program_) {
            glUniform3fv(3, 1, &box.colour.x);
            glUniform1ui(4, box.id);
        }
        glDrawArrays(GL_TRIANGLES, 0, 36);
    }
}

void Renderer::draw_depth(const std::vector<Box>& boxes, const glm::dmat4& clip_from_world,
                          const ShadowMap& into) const {
    glBindFramebuffer(GL_FRAMEBUFFER, into.framebuffer());
    glViewport(0, 0, map_side, map_side);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glUseProgram(depth_program_);
    const glm::mat4 matrix(clip_from_world);
    glUniformMatrix4fv(0, 1, GL_FALSE, &matrix[0].x);
    draw_boxes(boxes, depth_program_);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
}

void Renderer::draw(const std::vector<Box>& boxes, const glm::mat4& clip_from_world, const Lamp& lamp,
                    const ShadowMap& shadow, const Target& into) const {
    glBindFramebuffer(GL_FRAMEBUFFER, into.name());
    glViewport(0, 0, width, height);
    glUseProgram(program_);
    const glm::mat4 from_lamp(lamp.clip_from_world());
    const glm::vec3 position(lamp.position), towards(lamp.towards);
    glUniformMatrix4fv(0, 1, GL_FALSE, &clip_from_world[0].x);
    glUniformMatrix4fv(5, 1, GL_FALSE, &from_lamp[0].x);
    glUniform3fv(6, 1, &position.x);
    glUniform3fv(7, 1, &towards.x);
    glUniform4f(8, lamp.radiance.x, lamp.radiance.y, lamp.radiance.z,
                lamp.reference_distance * lamp.reference_distance);
    glUniform1f(9, std::cos(lamp.outer_radians));
    glBindTextureUnit(0, shadow.texture());
    draw_boxes(boxes, program_);
}

}  // namespace room
