#pragma once
/// What a FaceAsset holds: the face, and what is found about it once.

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "rig/controls/head_and_eyes.h"
#include "rig/controls/rig.h"
#include "rig/head/eye_sockets.h"
#include "rig/head/face_scale.h"
#include "rig/head/material_kind.h"
#include "rig/head/sockets.h"
#include "rig/light/occlusion.h"
#include "runtime/draw/extents.h"
#include "runtime/draw/skin_surface.h"
#include "runtime/files/face_appearance.h"

namespace blush {

struct AssetState {
    AssetState(Face loaded, Rig its);

    Face face;
    Rig rig;
    FaceAppearance appearance;
    std::optional<OcclusionSet> occlusion;

    HeadAndEyes head_and_eyes;
    Bounds bounds;  ///< moving_bounds()
    FaceScale scale;
    SkinSurface skin;
    Extents extents;
    std::vector<MaterialKind> material_kind;                ///< of each material and, last, the default one
    EyeSockets eye_sockets;                                 ///< none where it has no eyeballs
    std::vector<std::uint8_t> target_needs_turned_normals;  ///< of each target, for Primitive::normal_source recomputed
    std::vector<std::uint8_t> target_moves_normals;         ///< of each target, for any primitive that it moves
    std::size_t joint_count = 0;                            ///< of all skins
    bool has_triangles = false;
    /// Where skinned vertices have their origin in the face's space: near them, so that their floats are fine.
    glm::dvec3 skinned_origin{0};
    std::vector<glm::dmat4> rest_placement;          ///< face_from_node at rest
    std::vector<glm::dmat4> rest_skinned_from_mesh;  ///< of all joints, less skinned_origin
    std::array<SocketSource, socket_count> sockets;
    std::vector<glm::vec3> mesh_origin;  ///< of each mesh: what was taken off the file's vertices (rig/far_vertices.h)
    std::vector<glm::dvec3> joint_mesh_origin;  ///< of each joint of all skins: that of the meshes that follow it
    double float_step_mm = 0;                   ///< FaceAsset::float_step_mm()
    /// Tells surfaces apart: copies with other maps share it.
    std::shared_ptr<const char> geometry = std::make_shared<const char>();
};

}  // namespace blush
