#pragma once
/// An effect is one thing with five faces, declared in one place: settings, the predicate that says whether a scene
/// needs it, the passes that it adds, its part of shading, its hard cases. Nothing else in the frame knows it by name:
/// the frame walks the registry, `explain` reads the predicates, the stability tests the hard cases. The sixth, its
/// slow exact twin, stands apart in runtime/measure/, which no engine links. docs/adding_an_effect.md is the checklist.

#include <array>
#include <span>
#include <string_view>

#include "rig/face.h"
#include "runtime/character.h"
#include "runtime/frame/hard_case.h"
#include "runtime/frame/setting.h"
#include "runtime/frame/shading_part.h"
#include "runtime/frame_report.h"
#include "runtime/settings.h"
#include "runtime/view.h"

namespace blush {

struct CharacterState;
struct FrameState;

/// Where in a frame an effect's passes stand (runtime/frame/frame.cpp).
enum class Stage : std::uint8_t {
    surface,  ///< before anything is drawn: what moves the surface
    light,    ///< on the finished surface: what shading reads (shadow maps, velocities)
    resolve,  ///< multisampled images become single ones
    scene,    ///< on the shaded image, in linear radiance: FrameResources::scene_color and its companions
    filter,   ///< on each finished picture, display values or radiance: see next_display() in runtime/frame/frame.h
    average,  ///< of a frame's pictures, on each but the first
    history,  ///< the frame before is blended in
    display,  ///< on the display image, after the filmic curve; not of a view that asks for radiance
};

/// Answer of a predicate.
struct Need {
    bool on = false;
    std::string_view reason;
    Omission omission = Omission::exact;
    double bound = 0;
    std::string_view bound_unit = {};
    bool can_be_forced = true;  ///< false: the face has nothing for the effect to work on
};

/// A setting that takes an effect out of every frame.
inline constexpr std::array<std::string_view, 2> yes_or_no = {"yes", "no"};
constexpr Setting shown_setting(std::string_view meaning) { return {"shown", meaning, yes_or_no}; }

struct Effect {
    std::string_view name;
    std::string_view what;
    std::span<const Setting> settings;
    SettingOwner owner = SettingOwner::character;  ///< of its settings
    Stage stage = Stage::surface;
    /// Find what predicates and passes ask, before any need is: of the characters, and of what the view has been given
    /// (lights, places). Null: nothing to find.
    void (*find_facts)(FrameState&) = nullptr;
    void (*find_in_view)(FrameState&) = nullptr;
    /// Reads facts and settings; where it depends on another effect's need, that one stands earlier in the registry.
    /// One of the two: asked once for the view, or for each character.
    Need (*need)(const FrameState&) = nullptr;
    Need (*character_need)(const FrameState&, const CharacterState&) = nullptr;
    /// Adds passes, once for all characters. Null: shading does it.
    void (*declare)(FrameState&) = nullptr;
    /// What it brings to shading; null: nothing.
    const ShadingPart* shading = nullptr;
    /// Remembers what its passes have left, at the end of a frame, for each character that it was on for.
    void (*finish)(CharacterState&) = nullptr;
    std::span<const HardCase> hard_cases;
};

/// All effects, in the order in which a frame applies them.
std::span<const Effect* const> effects();

}  // namespace blush
