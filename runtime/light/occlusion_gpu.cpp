#include "runtime/light/occlusion_gpu.h"

#include <array>
#include <numbers>

namespace blush {

std::vector<glm::vec4> packed_occlusion(const OcclusionSet& set) {
    constexpr auto pi = std::numbers::pi_v<float>;
    // The cosine's convolution by band (rig/light/spherical_harmonics.h).
    constexpr std::array<float, 9> band = {pi, pi / 1.5F, pi / 1.5F, pi / 1.5F, pi / 4, pi / 4, pi / 4, pi / 4, pi / 4};
    std::vector<glm::vec4> packed;
    for (const OcclusionPose& pose : set.poses) {
        for (const LightTransfer& transfer : pose.transfers) {
            std::array<float, 9> h{};
            for (std::size_t i = 0; i < 9; ++i) h[i] = transfer[i] / band[i];
            packed.emplace_back(h[0], h[1], h[2], h[3]);
            packed.emplace_back(h[4], h[5], h[6], h[7]);
            packed.emplace_back(h[8], 0, 0, 0);
        }
    }
    return packed;
}

void bind_occlusion(CharacterState& character) {
    auto& own = character.model->own<OcclusionBuffer>();
    if (!own.coefficients)
        own.coefficients = gl::make_buffer<glm::vec4>(packed_occlusion(*character.facts_of_face.occlusion));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, BLUSH_OCCLUSION_BINDING, own.coefficients.name());
}

}  // namespace blush
