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

std::size_t index_of(const Effect& effect) {
    const std::span<const Effect* const> registry = effects();
    return static_cast<std::size_t>(std::ranges::find(registry, &effect) - registry.begin());
}

constexpr std::string_view no_unit_left = "all texture units of the device are taken";

/// Takes an effect out of a character's shading, and what builds on it, with a bound that says nothing is promised.
void leave_out(FrameState& frame, CharacterState& character, const Effect& effect) {
    const ShadingLayout& layout = shading_layout(frame.shared);
    for (std::size_t k = 0; k < layout.parts.size(); ++k) {
        const Effect* part = layout.parts[k].effect;
        const bool goes = part == &effect || part->shading->builds_on == &effect;
        if (!goes || (character.shading.parts >> k & 1U) == 0) continue;
        character.shading.parts &= ~(1U << k);
        character.effects_on[index_of(*part)] = 0;
        std::vector<EffectReport>& reports = character.report->effects;
        std::erase_if(reports, [part](const EffectReport& report) { return report.effect == part->name; });
        reports.push_back({part->name, false, no_unit_left, Omission::bounded, 1, "of the picture's whole range"});
    }
}

/// Leaves out, from the last on, effects whose textures find no unit beside those of the face's materials.
void fit_textures(FrameState& frame, CharacterState& character) {
    const ShadingLayout& layout = shading_layout(frame.shared);
    const auto units = static_cast<std::uint32_t>(std::max(0, frame.device.info().texture_units));
    for (std::size_t k = layout.parts.size(); k-- > 0;) {
        if (shading_units(frame.shared, character, character.shading) <= units) return;
        const Effect& effect = *layout.parts[k].effect;
        if ((character.shading.parts >> k & 1U) != 0 && effect.shading->textures != 0)
            leave_out(frame, character, effect);
    }
}

/// An effect that no character is left with is off for the view too.
void report_left_out(FrameState& frame) {
    const auto left_out = [](const CharacterState* character, std::string_view name) {
        return std::ranges::any_of(character->report->effects, [name](const EffectReport& report) {
            return report.effect == name && report.reason == no_unit_left;
        });
    };
    for (EffectReport& report : frame.report.effects) {
        if (!report.on || frame.characters.empty()) continue;
        const bool none_left = std::ranges::all_of(
            frame.characters, [&](const CharacterState* character) { return left_out(character, report.effect); });
        if (none_left)
            report = {report.effect, false, no_unit_left, Omission::bounded, 1, "of the picture's whole range"};
    }
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
    report_left_out(frame);
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
