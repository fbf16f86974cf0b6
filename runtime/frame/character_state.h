#pragma once
/// What a Character holds: one face in the world, its pose and its deformed surface. What characters of one face have
/// in common stands in its asset and in its model.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "rig/deform/blend_shapes.h"
#include "rig/motion/blood_flow.h"
#include "runtime/deform/stream_out.h"
#include "runtime/device.h"
#include "runtime/draw/face_model.h"
#include "runtime/face_asset.h"
#include "runtime/frame/asset_state.h"
#include "runtime/frame/frame_graph.h"
#include "runtime/frame/shading_part.h"
#include "runtime/frame/stand.h"
#include "runtime/frame/store.h"
#include "runtime/frame_report.h"
#include "runtime/gl/shared_blocks.h"
#include "runtime/light/scene_lights.h"
#include "runtime/settings.h"
#include "runtime/surface.h"

namespace blush {

struct Effect;
struct PinnedSurface;

/// What predicates ask of a character's pose; found once a frame.
struct CharacterFacts {
    std::uint32_t active_targets = 0;
    bool active_need_turned_normals = false;  ///< an active target moves a primitive whose normals turn
    bool any_turned_normals = false;          ///< some target of the face does
    bool deformation_current = false;         ///< deformed() holds what these weights and settings give
    bool has_joints = false;
    bool skinned = false;       ///< skinned() holds what these joints, weights and settings give
    bool pinned = false;        ///< some vertex is pinned
    bool pins_applied = false;  ///< the pinned surface is what this stance and these settings give
    bool forced = false;
};

/// The surface as it was in an earlier frame of the scene.
struct LastSurface {
    std::uint64_t frame = 0;  ///< SceneState::frame that it is of; 0: none
    Stance stance;
    gl::Buffer positions;
};

struct CharacterState {
    CharacterState(Device on, FaceAsset shows, std::shared_ptr<FaceModel> its);

    Device device;
    FaceAsset asset;
    const AssetState& facts_of_face;
    const Face& face;
    const Rig& rig;
    std::shared_ptr<FaceModel> model;
    StreamOut stream_out;

    std::vector<float> controls;
    Pose pose;
    const BloodFlow* blood = nullptr;  ///< where the blood is, when it does not follow the pose at once
    EffectSettings settings;
    glm::dmat4 world_from_face{1};
    std::vector<glm::mat4> host_joints;  ///< of all skins, in the face's space; empty: those of the face's own nodes

    // The pose that the deformed buffers hold.
    std::vector<ActiveTarget> deformed_active;
    EffectSettings deformed_settings;
    bool deformed_valid = false;
    struct {  ///< what skinned() was made from
        bool valid = false;
        std::vector<ActiveTarget> active;
        std::vector<glm::mat4> joints;
        EffectSettings settings;
    } skinned;
    std::shared_ptr<PinnedSurface> pinned;  ///< none: the host pins nothing
    LastSurface last;

    // The frame being drawn.
    CharacterFacts facts;
    Stance stance;
    std::vector<glm::dmat4> face_from_node;
    NormalMethod normal_method = NormalMethod::authored;
    double scale_of_place = 1;      ///< world units a unit of the file
    double millimetres_a_unit = 1;  ///< of the world
    glm::dvec3 centre_world{0};     ///< of a sphere around it
    double radius_world = 0;
    const SurfaceBuffers* surface = nullptr;      ///< as far as it has come; in the end what is drawn
    const SurfaceBuffers* skin_source = nullptr;  ///< of the joints
    struct Resources {
        ResourceId positions{}, normals{}, tangents{};                          ///< the surface as far as it has come
        ResourceId morphed_positions{}, morphed_normals{}, morphed_tangents{};  ///< before joints
    } resources;

    // The view being drawn.
    std::uint32_t index = 0;  ///< among the frame's characters
    bool moves = false;       ///< it may stand elsewhere than in the view's last frame
    SkinOnScreen skin;
    /// Of the coordinates that shading knows, with the world's axes: in the middle of the head, where floats are
    /// finest. From the camera, a triangle of a pixel has edges that differ by more than a shadow map's bias.
    glm::dvec3 origin_world{0};
    glm::mat4 view_from_shading{1};
    std::vector<glm::mat4> shading_from_node;  ///< and, last, where skinned vertices stand
    std::vector<std::uint32_t> reaching;       ///< lights of the frame that reach it
    std::vector<shared::Light> shader_lights;  ///< the same, with their shadow maps where they have one
    std::uint32_t shadow_lights = 0;           ///< of them that have one
    /// Light from all around, as shared::FrameBlock has it.
    std::array<glm::vec4, 9> ambient_sh{};
    CharacterReport* report = nullptr;
    std::vector<std::uint8_t> effects_on;  ///< of each effect of the registry
    Shading shading;                       ///< effects that shade it
    DrawBlocks draw_blocks;
    gl::Buffer frame_block;    ///< shared::FrameBlock
    gl::Buffer effects_block;  ///< numbers of effects: runtime/draw/shading.h
    std::vector<std::byte> effects_staging;
    Store store;

    std::vector<SurfacePrimitive> published;  ///< what Character::surface() last said

    /// Whether an effect takes part in this frame for this character. Known once needs are found.
    bool on(const Effect& effect) const;

    /// The surface before joints: deformed, or at rest where no target is active.
    const SurfaceBuffers& morphed() const {
        return facts.active_targets == 0 && !facts.forced ? stream_out.rest() : stream_out.deformed();
    }
    /// Targets with a weight, of this frame.
    const std::vector<ActiveTarget>& active() const { return stance.active; }

    /// What one effect keeps for this character, made when first asked for: `T` is the effect's own type.
    template <class T>
    T& own() {
        return store.get<T>();
    }
};

}  // namespace blush
