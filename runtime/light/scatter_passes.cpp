#include "runtime/light/scatter_passes.h"

#include <cmath>
#include <string>

#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

glm::vec4 with(glm::dvec3 rgb, double w) { return {glm::vec3(rgb), static_cast<float>(w)}; }

}  // namespace

void ScatterTable::write(std::span<const ScatterCharacter> characters,
                         std::span<const std::vector<KernelTap>> kernels) {
    values_.assign(BLUSH_MOST_SCATTERING, glm::vec4(0, 0, 1, -2));
    const std::size_t taps = kernels.empty() || kernels[0].empty() ? 0 : kernels[0].size() - 1;
    for (const ScatterCharacter& character : characters) {
        values_[character.number % BLUSH_MOST_SCATTERING] =
            glm::vec4(static_cast<float>(character.profile * taps), static_cast<float>(character.follow_mm),
                      static_cast<float>(character.scale), static_cast<float>(character.profile));
    }
    for (const std::vector<KernelTap>& kernel : kernels) {
        for (const KernelTap& tap : kernel) {
            if (tap.offset_mm != 0) values_.push_back(with(tap.weight, tap.offset_mm));
        }
    }
    const std::size_t bytes = values_.size() * sizeof(glm::vec4);
    if (capacity_ < bytes) {
        capacity_ = 2 * bytes;
        buffer_ = gl::make_buffer(capacity_, nullptr, GL_DYNAMIC_STORAGE_BIT);
    }
    glNamedBufferSubData(buffer_.name(), 0, static_cast<GLsizeiptr>(bytes), values_.data());
}

const gl::Program& ScatterPasses::program(Kind kind, bool composite, bool many) {
    gl::Program& kept = programs_[static_cast<std::size_t>(kind) * 4 + (composite ? 1 : 0) + (many ? 2 : 0)];
    if (kept) return kept;
    constexpr std::array<std::string_view, 7> defines_of_kind = {"TAPS 9",   "TAPS 17",  "TAPS 25", "TAPS 33",
                                                                 "GAUSSIAN", "JITTERED", "PLAIN"};
    std::vector<std::string_view> defines = {defines_of_kind[static_cast<std::size_t>(kind)]};
    if (composite) defines.emplace_back("COMPOSITE");
    if (many) defines.emplace_back("MANY");
    gl::require_program(kept, {"screen.vert", "light/scatter.frag", defines});
    if (!framebuffer_) {
        framebuffer_ = gl::make_framebuffer();
        no_attributes_ = gl::make_vertex_array();
    }
    return kept;
}

void ScatterPasses::require(ScatterMethod method, std::uint32_t taps, bool many) {
    if (method == ScatterMethod::separable) {
        const auto kind = static_cast<Kind>((taps - 9) / 8);
        program(kind, false, many);
        program(kind, true, many);
    } else if (method == ScatterMethod::jittered) {
        program(Kind::jittered, true, many);
    } else if (method != ScatterMethod::off) {
        program(Kind::gaussian, false, many);
        program(Kind::plain, false, many);
        program(Kind::plain, true, many);
    }
}

void ScatterPasses::begin(const ScatterInput& input, const gl::Program& used, GLuint light, GLuint target) {
    glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, target, 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, static_cast<GLsizei>(input.width), static_cast<GLsizei>(input.height));
    glUseProgram(used.name());
    glBindTextureUnit(BLUSH_SKIN_LIGHT_UNIT, light);
    glBindTextureUnit(BLUSH_SKIN_DEPTH_UNIT, input.depth);
    glBindTextureUnit(BLUSH_SKIN_ALBEDO_UNIT, input.albedo);
    glBindSampler(BLUSH_SKIN_LIGHT_UNIT, 0);
    glBindSampler(BLUSH_SKIN_DEPTH_UNIT, 0);
    glBindSampler(BLUSH_SKIN_ALBEDO_UNIT, 0);
    glUniform2f(0, static_cast<float>(input.projection.scale.x), static_cast<float>(input.projection.scale.y));
    glUniform1f(1, static_cast<float>(input.projection.perspective));
    if (input.table != nullptr) {
        glUniform1i(43, input.only_profile);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BLUSH_SCATTER_BINDING, input.table->name());
    } else {
        glUniform1f(2, static_cast<float>(input.follow_mm));
    }
    glBindVertexArray(no_attributes_.name());
}

void ScatterPasses::separable(const ScatterInput& input, const std::vector<KernelTap>& taps,
                              const ScatterScratch& scratch, GLuint scene) {
    const auto kind = static_cast<Kind>((taps.size() - 9) / 8);
    const bool many = input.table != nullptr;
    packed_.clear();
    for (const KernelTap& tap : taps) {
        if (tap.offset_mm != 0) packed_.push_back(with(tap.weight, tap.offset_mm));
    }
    const auto set_taps = [this, many] {
        if (!many) glUniform4fv(11, static_cast<GLsizei>(packed_.size()), &packed_[0].x);
    };
    // The first pass knows skin by its matte and marks it; in the second one the stencil test spares all else
    // (jimenez-2012, 6.3).
    const gl::Program& across = program(kind, false, many);
    begin(input, across, input.light, scratch.first);
    glNamedFramebufferTexture(framebuffer_.name(), GL_STENCIL_ATTACHMENT, scratch.stencil, 0);
    const GLint unmarked = 0;
    glClearNamedFramebufferiv(framebuffer_.name(), GL_STENCIL, 0, &unmarked);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 1, 0xff);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    // Neighbours of skin are read by the second pass, so what no fragment writes must be empty.
    const std::array<float, 4> nothing{};
    glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, nothing.data());
    glUniform2f(3, 1, 0);
    set_taps();
    glDrawArrays(GL_TRIANGLES, 0, 3);

    begin(input, program(kind, true, many), scratch.first, scene);
    glStencilFunc(GL_EQUAL, 1, 0xff);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
    glUniform2f(3, 0, 1);
    set_taps();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
    glDisable(GL_STENCIL_TEST);
    glNamedFramebufferTexture(framebuffer_.name(), GL_STENCIL_ATTACHMENT, 0, 0);
}

void ScatterPasses::gaussians(const ScatterInput& input, std::span<const GaussianTerm> profile,
                              const ScatterScratch& scratch, GLuint scene) {
    const auto width = static_cast<GLsizei>(input.width), height = static_cast<GLsizei>(input.height);
    const gl::Program& blur = program(Kind::gaussian, false, input.table != nullptr);
    for (const GLuint target : {scratch.first, scratch.second}) {
        glClearTexImage(target, 0, GL_RGBA, GL_FLOAT, nullptr);
    }
    if (input.only_profile <= 0)
        glCopyImageSubData(input.light, GL_TEXTURE_2D, 0, 0, 0, 0, scratch.third, GL_TEXTURE_2D, 0, 0, 0, 0, width,
                           height, 1);
    std::array<float, 4> weights{};
    double total = 0;
    for (int k = -3; k <= 3; ++k) total += std::exp(-0.5 * k * k);
    for (std::size_t k = 0; k < weights.size(); ++k) {
        weights[k] = static_cast<float>(std::exp(-0.5 * static_cast<double>(k * k)) / total);
    }
    glm::dvec3 weight_so_far = profile[0].weight;
    GLuint light = input.light;
    for (std::size_t g = 1; g < profile.size(); ++g) {
        const double step_mm = std::sqrt(profile[g].variance_mm2 - profile[g - 1].variance_mm2);
        constexpr float beta = 800, gamma_mm = 0.001F * 240;  // rig/light/scatter_image.cpp
        for (int direction = 0; direction < 2; ++direction) {
            begin(input, blur, light, direction == 0 ? scratch.first : scratch.second);
            glUniform2f(3, direction == 0 ? 1 : 0, direction == 0 ? 0 : 1);
            glUniform4f(4, static_cast<float>(step_mm), static_cast<float>(std::sqrt(profile[g].variance_mm2)), beta,
                        gamma_mm);
            glUniform1fv(5, 4, weights.data());
            glDrawArrays(GL_TRIANGLES, 0, 3);
            light = direction == 0 ? scratch.first : scratch.second;
        }
        // Accumulated by blending with the weights of eq. 4.8 (there in one pass with the blur, by two targets).
        weight_so_far += profile[g].weight;
        const glm::vec3 share(profile[g].weight / weight_so_far);
        begin(input, program(Kind::plain, false, input.table != nullptr), light, scratch.third);
        glEnable(GL_BLEND);
        glBlendColor(share.r, share.g, share.b, 1);
        glBlendFuncSeparate(GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_COLOR, GL_ONE, GL_ZERO);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glDisable(GL_BLEND);
    }
    begin(input, program(Kind::plain, true, input.table != nullptr), scratch.third, scene);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
}

void ScatterPasses::jittered(const ScatterInput& input, const JitteredKernel& kernel, GLuint scene) {
    begin(input, program(Kind::jittered, true, input.table != nullptr), input.light, scene);
    const glm::vec4 middle = with(kernel.middle.weight / 6.0, kernel.middle.radius_mm);
    const glm::vec4 wide = with(kernel.wide.weight / 6.0, kernel.wide.radius_mm);
    glUniform4fv(9, 1, &middle.x);
    glUniform4fv(10, 1, &wide.x);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
}

std::uint32_t ScatterPasses::fetches_a_pixel(ScatterMethod method, std::uint32_t samples, bool follow) {
    const std::uint32_t a_tap = follow ? 2 : 1;
    switch (method) {
        case ScatterMethod::separable:
            return 2 * (3 + (samples - 1) * a_tap);  // light, depth, albedo and strength of the centre; taps
        case ScatterMethod::gaussians4:
        case ScatterMethod::gaussians6: {
            const std::uint32_t blurred = method == ScatterMethod::gaussians4 ? 3 : 5;
            return blurred * (2 * (3 + 2 + 6) + 3) + 3;  // centre, gradient, taps, twice; accumulated; composed
        }
        case ScatterMethod::jittered:
            return 3 + 12 * a_tap;
        case ScatterMethod::off:
            break;
    }
    return 0;
}

}  // namespace blush
