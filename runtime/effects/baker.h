#pragma once
/// What bakers have in common: effects whose work is done before any frame, by `blush bake`. They are registered for
/// their settings, studies and hard cases, and never take part in a frame.

#include "runtime/frame/character_state.h"
#include "runtime/frame/effect.h"

namespace blush {

/// Why a baker has nothing to do in this frame. reasons: where the face has its maps, and where it has none.
inline Need baker_need(const CharacterState& state, bool baked, std::string_view done, std::string_view not_done) {
    std::string_view reason = baked ? done : not_done;
    if (state.skin.parts.empty()) reason = "there is nothing to bake: the face has no skin";
    return {.on = false, .reason = reason, .can_be_forced = false};
}

inline void declare_nothing(CharacterState& /*state*/) {}

inline Variant baker_variant(std::string label, std::string work, bool is_default, std::function<void()> run,
                             std::function<Variant::Error()> error) {
    return {std::move(label), std::move(run), std::move(error), std::move(work), is_default};
}

}  // namespace blush
