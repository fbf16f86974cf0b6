#pragma once
/// What a View holds: what it keeps from frame to frame, and the frame that is being drawn. Effects, passes and the
/// frame share it.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "runtime/antialias/sampling.h"
#include "runtime/frame/character_state.h"
#include "runtime/frame/device_state.h"
#include "runtime/frame/finite_check.h"
#include "runtime/frame/frame_graph.h"
#include "runtime/frame/scene_state.h"
#include "runtime/frame_report.h"
#include "runtime/gl/timers.h"
#include "runtime/light/scene_lights.h"
#include "runtime/view.h"

namespace blush {

/// What the predicates of effects look at, found once a frame from the characters and the view.
struct SceneFacts {
    bool has_triangles = false;
    bool on_screen = false;  ///< some part of a face may be on the screen; false only where none can be
    bool skin_on_screen = false;
    bool forced = false;
    // Of views that compare frames; false in others.
    bool has_last_frame = false;  ///< the last frame can be compared with this one
    bool moves = false;           ///< ... and some point may stand elsewhere on the screen than in it
};

/// Resources of a picture that passes hand on to one another.
struct FrameResources {
    ResourceId scene_color_multisampled{}, scene_depth{}, scene_color{};
    /// What effects have shading write beside the colour (ShadingPart::targets), resolved.
    struct Target {
        const Effect* effect = nullptr;
        ResourceId id{};
    };
    std::array<Target, 7> targets{};  // GL has eight draw buffers at least
    std::size_t target_count = 0;
    ResourceId shadow_maps{};
    std::optional<ResourceId> log2_exposure;  ///< one texel; where the exposure is metered
    /// Multisampled images that shading writes and what they become, one sample a pixel: the scene's colour, and others
    /// that are resolved with its weights.
    struct Resolved {
        ResourceId from{}, to{};
    };
    std::array<Resolved, 8> to_resolve{};
    std::size_t resolve_count = 0;
    ResourceId velocities{};  ///< rgba16f, of the frame's last picture: shaders/antialias/velocities.frag
    ResourceId speeds{};      ///< speeds as far as they have come: filtered, averaged
    ResourceId display{};     ///< the picture as far as it has come: display values, or radiance
};

/// Framebuffers and programs of passes that every frame has; of the device.
struct CommonPasses {
    gl::Program tone, compose, write_velocities, move_depth, move_multisampled_depth;
    gl::Framebuffer scene, resolved, output, depth_only;
    gl::VertexArray no_attributes;
};

struct FrameState {
    explicit FrameState(Device on) : device(std::move(on)), shared(device.state()) {}

    Device device;
    DeviceState& shared;
    EffectSettings settings;

    // The frame being drawn.
    SceneState* scene = nullptr;
    std::span<CharacterState* const> characters;
    const ViewFrame* view = nullptr;
    SceneFacts facts;
    glm::dvec3 eye_world{0};      ///< where the camera stands
    glm::mat4 clip_from_view{1};  ///< GL's own convention, not moved
    Sampling sampling;            ///< of this frame
    Camera camera;                ///< the view's, moved to where the picture being drawn is sampled
    std::uint32_t picture = 0;    ///< the one being drawn, of sampling.pictures
    FrameGraph graph;
    FrameResources resources;
    double exposure_stops = 0;           ///< of the camera, beside ViewFrame::exposure; where it is not metered
    const Lighting* lighting = nullptr;  ///< the view's, the scene's, or portrait
    Lighting portrait;
    std::vector<LightSource> lights;  ///< that are not dark
    CommonPasses* common = nullptr;
    GLuint program_in_use = 0;  ///< by use_program() of runtime/draw/draw_face.h; 0: not known
    gl::Timers timers;
    FiniteCheck finite_check;
    FrameReport report;
    std::vector<std::uint8_t> effects_on;  ///< of each effect of the registry
    Store store;

    /// What one effect keeps for this view, made when first asked for: `T` is the effect's own type.
    template <class T>
    T& own() {
        return store.get<T>();
    }
    template <class T>
    T& shared_own() {
        return shared.store.get<T>();
    }
    /// Whether an effect takes part in this frame: for the view, or for any of its characters. Known once needs are
    /// found.
    bool on(const Effect& effect) const;
    /// An effect's target of shading, ShadingPart::targets[k]; the effect is on.
    ResourceId target(const Effect& effect, std::size_t k) const;
    /// Adds a character's share of the work to the report.
    void drew(CharacterState& character, std::uint32_t triangles);
};

}  // namespace blush
