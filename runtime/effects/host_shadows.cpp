/// Shadows that the host's world casts on the characters, from shadow maps that the host drew
/// (LightSource::host_shadow).

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame_state.h"
#include "runtime/frame/own_setting.h"
#include "runtime/gl/shared_blocks.h"

namespace blush::shared {
#include "shaders/light/host_shadows_uniforms.glsl"
}  // namespace blush::shared

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> method_choices = {"maps", "off"};
constexpr std::array<Setting, 1> settings = {
    {{"method", "maps: lights with a shadow map of the host's are hidden by what it shows; off: they are not",
      method_choices}}};
using Own = OwnSetting<host_shadows_effect, settings>;

/// A light's map as one character sees it.
struct HostMap {
    const HostShadow* shadow = nullptr;
    float texel_world = 0;  ///< width of a texel where the character stands, world units
};

/// The maps of the lights that reach a character, in the frame being drawn.
struct HostMaps {
    std::array<HostMap, BLUSH_MOST_HOST_SHADOWS> maps{};
    std::uint32_t count = 0;
    gl::Sampler nearest;
};

/// Width of a texel of a map at a place, world units; 0 where the map does not see it.
float texel_width(const HostShadow& shadow, const glm::dvec3& place) {
    GLint width = 0, height = 0;
    glGetTextureLevelParameteriv(shadow.depth_texture, 0, GL_TEXTURE_WIDTH, &width);
    glGetTextureLevelParameteriv(shadow.depth_texture, 0, GL_TEXTURE_HEIGHT, &height);
    if (width <= 0 || height <= 0) return 0;
    const glm::dmat4 rows = glm::transpose(glm::dmat4(shadow.clip_from_world));
    const glm::dvec4 clip = glm::dmat4(shadow.clip_from_world) * glm::dvec4(place, 1);
    if (!(clip.w > 0)) return 0;
    // How fast x and y of the map change with a step in the world.
    const auto change = [&](glm::length_t axis) {
        return glm::length(glm::dvec3(rows[axis]) * clip.w - glm::dvec3(rows[3]) * clip[axis]) / (clip.w * clip.w);
    };
    const double x = 2 / (change(0) * width), y = 2 / (change(1) * height), widest = std::max(x, y);
    return std::isfinite(widest) ? static_cast<float>(widest) : 0;
}

void find_in_view(FrameState& frame) {
    const bool off = frame.scene->settings.choice(Own("method")) == 1;
    for (CharacterState* character : frame.characters) {
        HostMaps& own = character->own<HostMaps>();
        own.count = 0;
        for (std::size_t k = 0; k < character->reaching.size() && !off; ++k) {
            const HostShadow& shadow = frame.lights[character->reaching[k]].host_shadow;
            if (shadow.depth_texture == 0 || own.count == own.maps.size()) continue;
            own.maps[own.count++] = {&shadow, texel_width(shadow, character->centre_world)};
            character->shader_lights[k].shadow_depth.w = static_cast<float>(own.count);
        }
    }
}

const HostMaps& maps_of(const CharacterState& character) { return *character.store.find<HostMaps>(); }

Need need(const FrameState& frame, const CharacterState& character) {
    if (frame.scene->settings.choice(Own("method")) == 1) {
        return {.on = false, .reason = "host_shadows.method is off", .can_be_forced = false};
    }
    if (maps_of(character).count == 0) {
        return {.on = false,
                .reason = "no light that reaches the character has a shadow map of the host's",
                .can_be_forced = false};
    }
    return {.on = true, .reason = "the host's world may hide a light from the character"};
}

std::uint32_t variant(const FrameState& /*frame*/, const CharacterState& character) {
    return (1U << (maps_of(character).count - 1)) - 1;
}

void write(const FrameState& /*frame*/, CharacterState& character, void* to) {
    auto& out = *static_cast<shared::HostShadowsUniforms*>(to);
    const HostMaps& own = maps_of(character);
    for (std::uint32_t m = 0; m < own.count; ++m) {
        const HostShadow& shadow = *own.maps[m].shadow;
        out.clip_from_world[m] =
            glm::mat4(glm::dmat4(shadow.clip_from_world) * glm::translate(glm::dmat4(1), character.origin_world));
        out.look_up[m] = {own.maps[m].texel_world + shadow.bias, shadow.depth_convention.zero_to_one ? 1 : 0,
                          shadow.depth_convention.reversed ? 1 : 0, 0};
    }
}

void bind(FrameState& /*frame*/, CharacterState& character, std::uint32_t unit) {
    HostMaps& own = character.own<HostMaps>();
    if (!own.nearest) {
        own.nearest = gl::make_sampler();
        const GLuint name = own.nearest.name();
        glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        glSamplerParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_NONE);
    }
    for (std::uint32_t m = 0; m < own.count; ++m) {
        glBindTextureUnit(unit + m, own.maps[m].shadow->depth_texture);
        glBindSampler(unit + m, own.nearest.name());
    }
}

const Lighting& map_without_a_view() {
    static const Lighting lighting = [] {
        Lighting odd;
        LightSource light;
        light.host_shadow.clip_from_world = glm::dmat4(0);
        odd.lights = {light};
        return odd;
    }();
    return lighting;
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"a light that names no map", "lit as without one", [](Face&) {}, 1,
     [](ViewFrame& view) { view.lighting = &map_without_a_view(); }},
}};

constexpr std::array<std::string_view, 2> hooks = {"lit", "through"};
constexpr std::array<ShadingVariant, BLUSH_MOST_HOST_SHADOWS - 1> variants = {
    {{"TWO_HOST_SHADOWS", 1}, {"THREE_HOST_SHADOWS", 1}, {"FOUR_HOST_SHADOWS", 1}}};
constexpr std::array<UniformField, 2> fields = {
    {{"clip_from_world[0]", offsetof(shared::HostShadowsUniforms, clip_from_world)},
     {"look_up[0]", offsetof(shared::HostShadowsUniforms, look_up)}}};
constexpr ShadingPart shading = {
    .file = "light/host_shadows.glsl",
    .hooks = hooks,
    .variants = variants,
    .variant = variant,
    .uniforms = {"light/host_shadows_uniforms.glsl", "HostShadowsUniforms", sizeof(shared::HostShadowsUniforms), fields,
                 write},
    .textures = 1,
    .bind = bind,
};

}  // namespace

const Effect host_shadows_effect = {
    .name = "host_shadows",
    .what = "what stands in the host's world casts shadows on the characters",
    .settings = settings,
    .owner = SettingOwner::scene,
    .stage = Stage::light,
    .find_in_view = find_in_view,
    .character_need = need,
    .shading = &shading,
    .hard_cases = hard_cases,
};

}  // namespace blush
