#pragma once
/// What a Character holds: the inside that effects, passes and the frame share.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <typeindex>
#include <unordered_map>
#include <vector>

#include "rig/controls/head_and_eyes.h"
#include "rig/controls/rig.h"
#include "rig/head/eye_sockets.h"
#include "rig/head/face_scale.h"
#include "rig/head/material_kind.h"
#include "rig/light/occlusion.h"
#include "rig/motion/blood_flow.h"
#include "runtime/antialias/sampling.h"
#include "runtime/deform/stream_out.h"
#include "runtime/device.h"
#include "runtime/draw/face_model.h"
#include "runtime/draw/skin_surface.h"
#include "runtime/files/face_appearance.h"
#include "runtime/frame/finite_check.h"
#include "runtime/frame/frame_graph.h"
#include "runtime/frame_report.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/gl/texture_pool.h"
#include "runtime/gl/timers.h"
#include "runtime/settings.h"
#include "runtime/view.h"

namespace blush {

/// What the predicates of effects look at, found once a frame from the pose and the view.
struct SceneFacts {
    std::uint32_t active_targets = 0;
    bool active_need_turned_normals = false;  ///< an active target moves a primitive whose normals turn
    bool any_turned_normals = false;          ///< some target of the face does
    bool deformation_current = false;         ///< deformed() holds what these weights and settings give
    bool has_joints = false;
    bool has_triangles = false;
    bool on_screen = false;  ///< some part of the face may be on the screen; false only where none can be
    bool forced = false;
    // Of temporal antialiasing; false in other modes.
    bool has_last_frame = false;  ///< the last frame can be compared with this one
    bool moves = false;           ///< ... and some point may stand elsewhere on the screen than in it
};

/// Resources of the frame that passes hand on to one another.
struct FrameResources {
    ResourceId positions{}, normals{}, tangents{};                          ///< the surface as far as it has come
    ResourceId morphed_positions{}, morphed_normals{}, morphed_tangents{};  ///< before joints
    ResourceId scene_color_multisampled{}, scene_depth{}, scene_color{};
    ResourceId blood_change{};  ///< what "blend blood" writes
    /// Light that scatters, the albedo that it leaves by, its depth, each times the skin's matte; with scattering only.
    ResourceId skin_light{}, skin_albedo{}, skin_depth{};
    ResourceId shadow_maps{};
    ResourceId log2_exposure{};  ///< one texel, with the automatic exposure only
    /// Multisampled images that shading writes and what they become, one sample a pixel: the scene's colour, and others
    /// that are resolved with its weights.
    struct Resolved {
        ResourceId from{}, to{};
    };
    std::array<Resolved, 6> to_resolve{};
    std::size_t resolve_count = 0;
    ResourceId velocities{};  ///< rgba16f, of the frame's last picture: shaders/antialias/velocities.frag
    ResourceId speeds{};      ///< speeds as far as they have come: filtered, averaged
    ResourceId display{};     ///< the picture as far as it has come: display values, or radiance
    ResourceId target{};      ///< what the picture goes to: the view's framebuffer, or a texture for averaging
};

struct Effect;

struct CharacterState {
    CharacterState(Device on, Face loaded, Rig its)
        : device(std::move(on)), face(std::move(loaded)), rig(std::move(its)) {}
    ~CharacterState() { device.make_current(); }  // the GL objects below must go in their own context

    Device device;
    Face face;
    Rig rig;
    HeadAndEyes head_and_eyes;
    Bounds bounds;
    std::vector<float> controls;
    Pose pose;
    const BloodFlow* blood = nullptr;  ///< where the blood is, when it does not follow the pose at once
    EffectSettings settings;
    FaceAppearance appearance;
    std::optional<OcclusionSet> occlusion;

    std::optional<StreamOut> stream_out;  // made right after construction: it refers to `face`
    FaceModel model;
    std::vector<std::uint8_t> target_needs_turned_normals;  // of each target, for Primitive::normal_source recomputed
    std::vector<std::uint8_t> target_moves_normals;         // of each target, for any primitive that it moves

    // The pose that the deformed buffers hold.
    std::vector<MaterialKind> material_kind;  // of each material and, last, the default one
    SkinSurface skin;
    EyeSockets eye_sockets;         // none where it has no eyeballs
    FaceScale scale;                // as the face itself tells
    double millimetres_a_unit = 1;  // that, or as the settings want it
    std::vector<ActiveTarget> active, deformed_active;
    NormalMethod normal_method = NormalMethod::authored;
    EffectSettings deformed_settings;
    bool deformed_valid = false;

    // The frame being drawn.
    const View* view = nullptr;
    SceneFacts facts;
    const SurfaceBuffers* surface = nullptr;  // the surface as far as it has come; in the end what is drawn
    const SurfaceBuffers* skin_source = nullptr;
    Sampling sampling;          // of this frame
    Camera camera;              // the view's, moved to where the picture being drawn is sampled
    std::uint32_t picture = 0;  // the one being drawn, of sampling.pictures
    FrameGraph graph;
    FrameResources resources;
    std::uint32_t images_left = 0;    // steps after the scene that have yet to declare themselves
    std::uint32_t kept_at = 0;        // the image with so many steps after it is kept for the next frame; 0: none
    std::vector<LightSource> lights;  // that are not dark
    std::vector<shared::Light> shader_lights;  // the same, with their shadow maps where they have one
    bool shadows_shown = false, translucency_shown = false;
    const Lighting* lighting = nullptr;  // the view's, or portrait
    Lighting portrait;
    std::vector<glm::mat4> world_from_node, skinned_from_mesh;
    gl::Program tone_program;
    gl::Framebuffer scene_framebuffer, resolved_framebuffer, output_framebuffer;
    gl::VertexArray no_attributes;
    gl::TexturePool textures;
    gl::Timers timers;
    FiniteCheck finite_check;
    FrameReport report;

    /// What one effect keeps for this character, made when first asked for: `T` is the effect's own type.
    template <class T>
    T& own() {
        std::shared_ptr<void>& kept = owned_[std::type_index(typeid(T))];
        if (!kept) kept = std::make_shared<T>();
        return *static_cast<T*>(kept.get());
    }
    /// Whether an effect takes part in this frame. Known once needs are found.
    bool on(const Effect& effect) const;

    /// The surface before joints: deformed, or at rest where no target is active.
    const SurfaceBuffers& morphed() const {
        return facts.active_targets == 0 && !facts.forced ? stream_out->rest() : stream_out->deformed();
    }

private:
    std::unordered_map<std::type_index, std::shared_ptr<void>> owned_;
};

}  // namespace blush
