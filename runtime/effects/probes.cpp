/// Light from all around that differs from place to place: probes, of which each character takes those that reach it.

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame_state.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/light/environment_map.h"

namespace blush::shared {
#include "shaders/light/probes_uniforms.glsl"
}  // namespace blush::shared

namespace blush {
namespace {

/// The probes that reach a character, in the frame being drawn.
struct ProbesHere {
    std::uint32_t count = 0;
    double share = 0;        ///< of them all
    Sh9Color radiance_sh{};  ///< by their shares
};

bool usable(const LightProbe& probe) {
    const auto finite = [](const glm::dvec3& v) { return std::isfinite(v.x + v.y + v.z); };
    return finite(probe.position_world) && probe.reach > 0 && std::isfinite(probe.reach) &&
           std::ranges::all_of(probe.radiance_sh, finite);
}

/// 1 at the probe, 0 from its reach on, without a step in its slope.
double share_of(const LightProbe& probe, const glm::dvec3& place) {
    const double near = 1 - std::min(glm::distance(place, glm::dvec3(probe.position_world)) / probe.reach, 1.0);
    return near * near * (3 - 2 * near);
}

ProbesHere gather(const Lighting& lighting, const glm::dvec3& place) {
    ProbesHere here;
    for (const LightProbe& probe : lighting.probes) {
        const double share = usable(probe) ? share_of(probe, place) : 0;
        if (share == 0) continue;
        ++here.count;
        here.share += share;
        for (std::size_t i = 0; i < 9; ++i) here.radiance_sh[i] += share * glm::dvec3(probe.radiance_sh[i]);
    }
    if (here.share > 1) {
        for (auto& coefficient : here.radiance_sh) coefficient /= here.share;
        here.share = 1;
    }
    constexpr double most = 6e4;  // what half floats hold
    for (auto& coefficient : here.radiance_sh) coefficient = glm::clamp(coefficient, -most, most);
    return here;
}

void find_in_view(FrameState& frame) {
    if (frame.lighting->probes.empty()) {
        for (CharacterState* character : frame.characters) character->own<ProbesHere>() = {};
        return;
    }
    for (CharacterState* character : frame.characters) {
        ProbesHere& here = character->own<ProbesHere>();
        here = gather(*frame.lighting, character->centre_world);
        if (here.count == 0) continue;
        for (std::size_t i = 0; i < 9; ++i) {
            const glm::dvec3 of_scene(glm::vec3(character->ambient_sh[i]));
            const glm::dvec3 mixed =
                (1 - here.share) * of_scene + white_share_of_band[i] * glm::dvec3(here.radiance_sh[i]);
            // What comes from every side of a probe is not known: none.
            const double least = (1 - here.share) * static_cast<double>(character->ambient_sh[i].w);
            character->ambient_sh[i] = glm::vec4(mixed, least);
        }
    }
}

const ProbesHere& probes_of(const CharacterState& character) { return *character.store.find<ProbesHere>(); }

Need need(const FrameState& /*frame*/, const CharacterState& character) {
    if (probes_of(character).count == 0) {
        return {.on = false, .reason = "no probe reaches the character", .can_be_forced = false};
    }
    return {.on = true, .reason = "the character stands among probes"};
}

void write(const FrameState& /*frame*/, CharacterState& character, void* to) {
    auto& out = *static_cast<shared::ProbesUniforms*>(to);
    const ProbesHere& here = probes_of(character);
    for (std::size_t i = 0; i < 9; ++i) out.radiance_sh[i] = glm::vec4(glm::vec3(here.radiance_sh[i]), 0);
    out.share = static_cast<float>(here.share);
}

const Lighting& odd_probes() {
    static const Lighting lighting = [] {
        Lighting odd;
        LightProbe nan, nowhere, bright;
        nan.radiance_sh[0] = DVec3(std::numeric_limits<double>::quiet_NaN());
        nowhere.reach = 0;
        bright.reach = 1e6;
        bright.radiance_sh[0] = DVec3(1e30);
        odd.probes = {nan, nowhere, bright};
        return odd;
    }();
    return lighting;
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"probes of NaN, without reach, beyond half precision",
     "those that light nothing are left out; the rest is limited", [](Face&) {}, 1,
     [](ViewFrame& view) { view.lighting = &odd_probes(); }},
}};

constexpr std::array<std::string_view, 1> hooks = {"ambient"};
constexpr std::array<UniformField, 2> fields = {{{"radiance_sh[0]", offsetof(shared::ProbesUniforms, radiance_sh)},
                                                 {"share", offsetof(shared::ProbesUniforms, share)}}};
constexpr ShadingPart shading = {
    .file = "light/probes.glsl",
    .hooks = hooks,
    .uniforms = {"light/probes_uniforms.glsl", "ProbesUniforms", sizeof(shared::ProbesUniforms), fields, write},
};

}  // namespace

const Effect probes_effect = {
    .name = "probes",
    .what = "light from all around differs from place to place",
    .settings = {},
    .owner = SettingOwner::scene,
    .stage = Stage::light,
    .find_in_view = find_in_view,
    .character_need = need,
    .shading = &shading,
    .hard_cases = hard_cases,
};

}  // namespace blush
