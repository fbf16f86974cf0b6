#include "runtime/light/environment_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "rig/light/spherical_harmonics.h"

namespace blush {
namespace {

struct EnvironmentMap {
    gl::Texture texture;
    gl::Sampler sampler;
    std::uint64_t identity = 0;
};

/// Radiance that comes from every side.
using Coefficients = std::array<glm::vec4, 9>;

void write_least(glm::vec3 radiance, Coefficients& out) {
    for (std::size_t c = 0; c < 3; ++c) out[c].w = radiance[static_cast<glm::length_t>(c)];
}

/// White reflects ground + (sky - ground) (1 + n.y) / 2: bands 0 and 1.
void write_sky(glm::vec3 sky, glm::vec3 ground, Coefficients& out) {
    const Sh9 up = sh_basis({0, 1, 0});
    out[0] = glm::vec4(0.5F * (sky + ground) / static_cast<float>(up[0]), 0);
    out[1] = glm::vec4(0.5F * (sky - ground) / static_cast<float>(up[1]), 0);
    write_least(glm::min(sky, ground), out);
}

float finite_or(float value, float otherwise) { return std::isfinite(value) ? value : otherwise; }

}  // namespace

EnvironmentView environment_view(const Lighting& lighting) {
    return {std::clamp(finite_or(lighting.environment_factor, 0), 0.0F, 1e4F),
            std::remainder(finite_or(lighting.environment_turn_radians, 0), 2 * std::numbers::pi_v<float>)};
}

std::array<glm::vec4, 9> ambient_sh(const Lighting& lighting) {
    Coefficients out{};
    if (lighting.environment == nullptr) {
        write_sky(lighting.sky_radiance_linear, lighting.ground_radiance_linear, out);
        return out;
    }
    const auto [factor, turn] = environment_view(lighting);
    const glm::dmat3 rotation(glm::rotate(glm::dmat4(1), static_cast<double>(turn), glm::dvec3(0, 1, 0)));
    const Sh9Color turned = rotate(sh_rotation(rotation), lighting.environment->radiance_sh);
    for (std::size_t i = 0; i < 9; ++i) {
        out[i] = glm::vec4(glm::vec3(turned[i] * white_share_of_band[i] * static_cast<double>(factor)), 0);
    }
    // The darkest side of the map as the roughest mirror sees it: a vertex is open to more than a texel.
    glm::vec3 least(std::numeric_limits<float>::max());
    const Environment::Level& blurred = lighting.environment->levels.back();
    for (std::size_t i = 0; i < blurred.rgb_linear.size(); ++i) {
        float& channel = least[static_cast<glm::length_t>(i % 3)];
        channel = std::min(channel, factor * blurred.rgb_linear[i]);
    }
    write_least(least, out);
    return out;
}

void bind_environment(FrameState& frame, std::uint32_t unit) {
    auto& map = frame.scene->own<EnvironmentMap>();
    const Environment& environment = *frame.lighting->environment;
    if (map.identity != environment.identity) {
        map.texture = gl::make_texture(GL_TEXTURE_2D);
        const auto levels = static_cast<GLsizei>(environment.levels.size());
        const auto width = static_cast<GLsizei>(environment.levels[0].width);
        const auto height = static_cast<GLsizei>(environment.levels[0].height);
        const GLsizei most = 1 + static_cast<GLsizei>(std::floor(std::log2(std::max(width, height))));
        glTextureStorage2D(map.texture.name(), std::min(levels, most), GL_RGB16F, width, height);
        for (GLint k = 0; k < std::min(levels, most); ++k) {
            const Environment::Level& level = environment.levels[static_cast<std::size_t>(k)];
            glTextureSubImage2D(map.texture.name(), k, 0, 0, static_cast<GLsizei>(level.width),
                                static_cast<GLsizei>(level.height), GL_RGB, GL_FLOAT, level.rgb_linear.data());
        }
        map.sampler = gl::make_sampler();
        glSamplerParameteri(map.sampler.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        glSamplerParameteri(map.sampler.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        map.identity = environment.identity;
    }
    glBindTextureUnit(unit, map.texture.name());
    glBindSampler(unit, map.sampler.name());
}

}  // namespace blush
