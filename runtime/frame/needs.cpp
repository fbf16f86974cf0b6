#include "runtime/frame/needs.h"

#include <algorithm>

#include "runtime/draw/shading.h"
#include "runtime/frame/effect.h"

namespace blush {
namespace {

EffectReport report_of(const Effect& effect, const Need& need, bool forced) {
    const bool on = need.on || (forced && need.can_be_forced);
    return {effect.name, on, on && !need.on ? "forced on" : need.reason, need.omission, need.bound, need.bound_unit};
}

/// Of one effect that is asked for each character: on where any has it, else the weakest reason to leave it out.
EffectReport find_character_needs(FrameState& frame, const Effect& effect, std::size_t index) {
    EffectReport all{effect.name, false, "the scene has no character", Omission::exact, 0, {}};
    bool first = true;
    for (CharacterState* character : frame.characters) {
        const EffectReport one = report_of(effect, effect.character_need(frame, *character), frame.facts.forced);
        character->report->effects.push_back(one);
        character->effects_on[index] = one.on ? 1 : 0;
        const bool weaker = !all.on && !one.on && one.omission == Omission::bounded;
        if (first || (one.on && !all.on) || weaker) all = one;
        first = false;
    }
    return all;
}

/// Takes an effect out of a character's shading, and what builds on it.
void leave_out(const ShadingLayout& layout, const Effect& effect, Shading& shading) {
    for (std::size_t k = 0; k < layout.parts.size(); ++k) {
        const Effect* part = layout.parts[k].effect;
        if (part == &effect || part->shading->builds_on == &effect) shading.parts &= ~(1U << k);
    }
}

/// Leaves out, from the last on, effects whose textures find no unit beside those of the face's materials.
void fit_textures(FrameState& frame, CharacterState& character) {
    const ShadingLayout& layout = shading_layout(frame.shared);
    const auto units = static_cast<std::uint32_t>(std::max(0, frame.device.info().texture_units));
    for (std::size_t k = layout.parts.size(); k-- > 0;) {
        if (shading_units(frame.shared, character, character.shading) <= units) return;
        const Effect& effect = *layout.parts[k].effect;
        if ((character.shading.parts >> k & 1U) == 0 || effect.shading->textures == 0) continue;
        leave_out(layout, effect, character.shading);
        std::vector<EffectReport>& reports = character.report->effects;
        std::erase_if(reports, [&effect](const EffectReport& report) { return report.effect == effect.name; });
        reports.push_back({effect.name, false, "all texture units of the device are taken", Omission::exact, 0, {}});
    }
}

std::size_t index_of(const Effect& effect) {
    const std::span<const Effect* const> registry = effects();
    return static_cast<std::size_t>(std::ranges::find(registry, &effect) - registry.begin());
}

}  // namespace

void find_needs(FrameState& frame) {
    const std::span<const Effect* const> registry = effects();
    frame.report.effects.clear();
    frame.effects_on.assign(registry.size(), 0);
    for (CharacterState* character : frame.characters) {
        character->report->effects.clear();
        character->effects_on.assign(registry.size(), 0);
    }
    for (std::size_t e = 0; e < registry.size(); ++e) {
        const Effect& effect = *registry[e];
        if (effect.need == nullptr && effect.character_need == nullptr) continue;
        const EffectReport report = effect.need != nullptr ? report_of(effect, effect.need(frame), frame.facts.forced)
                                                           : find_character_needs(frame, effect, e);
        frame.report.effects.push_back(report);
        frame.effects_on[e] = report.on ? 1 : 0;
    }
}

void find_shading(FrameState& frame) {
    for (CharacterState* character : frame.characters) {
        character->shading = shading_of(frame, *character);
        fit_textures(frame, *character);
    }
}

bool CharacterState::on(const Effect& effect) const {
    const std::size_t place = index_of(effect);
    return place < effects_on.size() && effects_on[place] != 0;
}

bool FrameState::on(const Effect& effect) const {
    const std::size_t place = index_of(effect);
    return place < effects_on.size() && effects_on[place] != 0;
}

}  // namespace blush
