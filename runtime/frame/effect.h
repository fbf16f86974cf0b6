#pragma once
/// An effect is one thing with five faces, declared in one place: settings, the predicate that says whether a scene
/// needs it, the passes that it adds, its slow exact twin, its hard cases. Nothing else in the house knows it by name:
/// the frame walks the registry, `explain` reads the predicates, `accuracy` the twins, the stability tests the hard
/// cases. docs/adding_an_effect.md is the checklist.

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/face.h"
#include "runtime/character.h"
#include "runtime/frame_report.h"
#include "runtime/settings.h"
#include "runtime/view.h"

namespace blush {

struct CharacterState;
struct FrameState;

/// One of a few named choices, or (without choices) a number in a range.
struct Setting {
    std::string_view name;
    std::string_view meaning;
    std::span<const std::string_view> choices = {};
    std::uint8_t default_choice = 0;
    double lowest = 0, highest = 0, default_number = 0;  ///< of a number; in the unit that `meaning` names
    std::optional<SettingOwner> owner = std::nullopt;    ///< where it is not the effect's
};

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

/// One way to compute something, to be compared with others: how long `run` takes, how far `error` says it is off.
struct Variant {
    std::string label;          ///< "deformation.method=sparse"
    std::function<void()> run;  ///< complete when it returns
    struct Error {
        double mean = 0, worst = 0;  ///< in the study's unit
        /// Of red, green and blue apart, where a study tells; else zero.
        std::array<double, 3> channel_mean{}, channel_worst{};
    };
    std::function<Error()> error;
    std::string work;  ///< counted: "52 targets, 14 passes, 1.4 M deltas"
    bool is_default = false;
};

/// Variants of one task on one face, with the reference that their errors are measured against.
struct Study {
    std::string name;       ///< "52 of 52 targets active, 26,719 vertices"
    std::string reference;  ///< "the sum in double precision on the CPU"
    std::string unit;       ///< "mm", "degrees", "CIEDE2000"
    std::vector<Variant> variants;
    std::shared_ptr<void> keeps;  ///< whatever the variants' functions refer to
};

/// A scene in which the effect might break: changes a face and its controls before they are loaded and drawn.
struct HardCase {
    std::string_view name;
    std::string_view expectation;
    void (*make)(Face& face);
    /// Weight of every target of that face.
    float weight = 1;
    /// Changes what the frame is drawn for; may be null.
    void (*look)(ViewFrame& view) = nullptr;
};

/// A setting that takes an effect out of every frame.
inline constexpr std::array<std::string_view, 2> yes_or_no = {"yes", "no"};
constexpr Setting shown_setting(std::string_view meaning) { return {"shown", meaning, yes_or_no}; }
/// Whether `shown` of that effect says no.
bool is_hidden(const EffectSettings& settings, std::string_view effect);

struct Effect {
    std::string_view name;
    std::string_view what;
    std::span<const Setting> settings;
    SettingOwner owner = SettingOwner::character;  ///< of its settings
    Stage stage = Stage::surface;
    /// Reads facts and settings; where it depends on another effect's need, that one stands earlier in the registry.
    /// One of the two: asked once for the view, or for each character. Neither: it takes no part in a frame.
    Need (*need)(const FrameState&) = nullptr;
    Need (*character_need)(const FrameState&, const CharacterState&) = nullptr;
    /// Adds passes, once for all characters. Null: shading does it.
    void (*declare)(FrameState&) = nullptr;
    /// `millimetres_a_unit`: scale of the face, for errors in millimetres.
    std::vector<Study> (*studies)(const Device&, const Face&, double millimetres_a_unit, bool quick);
    std::span<const HardCase> hard_cases;
};

/// All effects, in the order in which a frame applies them.
std::span<const Effect* const> effects();

extern const Effect wrinkle_baking_effect, wrinkles_effect, appearance_baking_effect, blood_effect;
extern const Effect pinning_effect;
extern const Effect deformation_effect, normals_effect, skinning_effect, velocities_effect, multisampling_effect,
    antialiasing_effect, supersampling_effect, reprojection_effect;
extern const Effect parts_effect, depth_of_field_effect, bloom_effect, exposure_effect, film_grain_effect;
extern const Effect shadows_effect, translucency_effect, reflection_effect, environment_effect, occlusion_effect,
    scattering_effect;

}  // namespace blush
