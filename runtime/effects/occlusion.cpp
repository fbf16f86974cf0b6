/// Light from all around reaches nostrils, lids and the inside of a mouth only so far as the face lets it
/// (chappuis-2011, 3.3). Shading does it, by coefficients that `blush bake occlusion` made.

#include <array>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame_state.h"
#include "runtime/frame/own_setting.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/light/occlusion_gpu.h"

namespace blush::shared {
#include "shaders/light/occlusion_uniforms.glsl"
}  // namespace blush::shared

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> method_choices = {"baked", "off"};
constexpr std::array<std::string_view, 2> bounce_choices = {"on", "off"};
constexpr std::array<Setting, 2> settings = {{
    {"method", "baked: by nine coefficients a vertex; off: nothing hides ambient light", method_choices, 0},
    {"bounces", "on: what hides a place shines as the place itself does; off: it is black", bounce_choices, 0},
}};
using Own = OwnSetting<occlusion_effect, settings>;

Need need(const FrameState& frame, const CharacterState& character) {
    if (!character.facts_of_face.occlusion) {
        return {.on = false, .reason = "no coefficients were baked for the face", .can_be_forced = false};
    }
    if (character.settings.choice(Own("method")) == 1) {
        return {.on = false, .reason = "occlusion.method is off", .can_be_forced = false};
    }
    const Lighting& lighting = *frame.lighting;
    if (lighting.environment == nullptr && lighting.sky_radiance_linear == glm::vec3(0) &&
        lighting.ground_radiance_linear == glm::vec3(0)) {
        return {.on = false, .reason = "no light comes from all around"};
    }
    return {.on = true, .reason = "light comes from all around, and the face hides some of it from itself"};
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"a face without coefficients", "lit as if it hid nothing", [](Face&) {}},
}};

void write(const FrameState& /*frame*/, CharacterState& character, void* to) {
    auto& out = *static_cast<shared::OcclusionUniforms*>(to);
    const OcclusionSet& set = *character.facts_of_face.occlusion;
    static_assert(most_occlusion_poses <= 4 * std::extent_v<decltype(out.weights)>);
    std::array<float, most_occlusion_poses> weights{};
    occlusion_weights(set, character.face, character.pose.weights, std::span(weights).first(set.poses.size()));
    for (std::size_t p = 0; p < set.poses.size(); ++p) {
        out.weights[p / 4][static_cast<glm::length_t>(p % 4)] = weights[p];
    }
    out.poses = static_cast<int>(set.poses.size());
    out.vertices = static_cast<int>(character.face.positions.size());
    out.bounces = character.settings.choice(Own("bounces")) == 0 ? 1 : 0;
}

void bind(FrameState& /*frame*/, CharacterState& character, std::uint32_t /*unit*/) { bind_occlusion(character); }

constexpr std::array<std::string_view, 2> hooks = {"visibility", "ambient"};
constexpr std::array<UniformField, 4> fields = {{{"poses", offsetof(shared::OcclusionUniforms, poses)},
                                                 {"vertices", offsetof(shared::OcclusionUniforms, vertices)},
                                                 {"bounces", offsetof(shared::OcclusionUniforms, bounces)},
                                                 {"weights[0]", offsetof(shared::OcclusionUniforms, weights)}}};
constexpr ShadingPart shading = {
    .file = "light/occluded_ambient.glsl",
    .vertex_file = "light/occlusion.glsl",
    .hooks = hooks,
    .uniforms = {"light/occlusion_uniforms.glsl", "OcclusionUniforms", sizeof(shared::OcclusionUniforms), fields,
                 write},
    .bind = bind,
};

}  // namespace

const Effect occlusion_effect = {
    .name = "occlusion",
    .what = "the face hides light from all around from itself",
    .settings = settings,
    .stage = Stage::light,
    .character_need = need,
    .shading = &shading,
    .hard_cases = hard_cases,
};

}  // namespace blush
