// Surface models are written once for whatever draws them: forward, deferred, in texture space.

#include <epoxy/gl.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/draw/shading.h"
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

std::string lit_by_a_compute_shader(DeviceState& device, const Permutation& permutation) {
    const ShadingSource source = shading_source(device, permutation);
    const std::vector<std::string_view> defines(source.defines.begin(), source.defines.end());
    const Result<std::string> text = gl::expand_shader("draw/shading.glsl", defines, &source.insertions);
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

/// All that may take part in shading a kind of material, in every variant.
std::vector<Permutation> permutations_of(DeviceState& device, MaterialKind kind) {
    const ShadingLayout& layout = shading_layout(device);
    Permutation all;
    all.model = kind;
    all.textures = 0x3F;
    std::uint32_t variants = 0;
    for (std::size_t k = 0; k < layout.parts.size(); ++k) {
        const ShadingPart& part = *layout.parts[k].effect->shading;
        if ((part.materials & materials_of(kind)) == 0) continue;
        all.shading.parts |= 1U << k;
        variants += static_cast<std::uint32_t>(part.variants.size());
    }
    std::vector<Permutation> result = {all};
    for (std::uint32_t v = 0; v < variants; ++v) {
        result.push_back(all);
        result.back().shading.variants = 1U << v;
    }
    return result;
}

using SurfaceModels = test::GlTest;

TEST_F(SurfaceModels, KnowNothingOfPixels) {
    DeviceState& state = device_.state();
    for (const MaterialKind kind :
         {MaterialKind::skin, MaterialKind::eye, MaterialKind::mouth, MaterialKind::hair, MaterialKind::other}) {
        for (const Permutation& permutation : permutations_of(state, kind)) {
            EXPECT_EQ(complaint_of(lit_by_a_compute_shader(state, permutation)), "") << static_cast<int>(kind);
        }
    }
}

}  // namespace
}  // namespace blush
