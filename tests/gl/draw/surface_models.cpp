// Surface models are written once for whatever draws them: forward, deferred, in texture space.

#include <epoxy/gl.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/gl/program.h"
#include "tests/gl_fixture.h"

namespace blush {
namespace {

/// What the driver says about `text` as a compute shader; nothing when it compiles.
std::string complaint_of(const std::string& text) {
    const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    std::array<char, 4096> log{};
    if (ok != GL_TRUE) glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    glDeleteShader(shader);
    return log.data();
}

std::string lit_by_a_compute_shader(std::vector<std::string_view> defines) {
    defines.insert(defines.end(), {"BASE_COLOR_MAP", "METALLIC_ROUGHNESS_MAP", "NORMAL_MAP", "OCCLUSION_MAP",
                                   "EMISSIVE_MAP", "SPECULAR_MAP", "SHADOWS", "ENVIRONMENT", "AMBIENT_OCCLUSION"});
    const Result<std::string> text = gl::expand_shader("draw/shading.glsl", defines);
    EXPECT_TRUE(text) << text.error().message;
    return *text + R"(
layout(local_size_x = 1) in;
layout(std430, binding = 7) buffer Given { float given[]; };
layout(std430, binding = 6) buffer Lit { vec4 lit[]; };
void main() {
    Interpolants at;
    at.position_world = vec3(given[0], given[1], given[2]);
    Lighting light = model_lighting(model_surface(at));
    lit[0] = vec4(light.entering + light.reflected + light.leaving, 0.0);
})";
}

using SurfaceModels = test::GlTest;

TEST_F(SurfaceModels, KnowNothingOfPixels) {
    const std::vector<std::vector<std::string_view>> models = {
        {},
        {"EYE"},
        {"MOUTH"},
        {"HAIR"},
        {"SKIN"},
        {"SKIN", "WRINKLES", "BLOOD", "SKIN_REFLECTION", "TRANSLUCENCY"},
        {"SKIN", "WRINKLES", "WRINKLE_DIFFERENCES", "BLOOD", "PIGMENT_COLOR"}};
    for (const auto& model : models) EXPECT_EQ(complaint_of(lit_by_a_compute_shader(model)), "");
}

}  // namespace
}  // namespace blush
