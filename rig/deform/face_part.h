#pragma once
/// A few vertices of a face, deformed by themselves: for what stands on the surface and must not wait for the GPU.

#include <cstdint>
#include <span>
#include <vector>

#include "rig/deform/vertex_path.h"
#include "rig/face.h"
#include "rig/vectors.h"

namespace blush {

/// Targets, turned normals and joints of those vertices alone, with the bits that deform_plain() and skin() give of the
/// whole face. What they need of the face is cut out of it once: their deltas, and the triangles around them.
class FacePart {
public:
    enum class Wanted : std::uint8_t {
        positions,   ///< normals and tangents stay undefined
        directions,  ///< positions, normals and tangents
    };
    /// vertices: distinct, below the number of the face's. Does not keep `face`.
    FacePart(const Face& face, std::span<const std::uint32_t> vertices, Wanted wanted);
    FacePart(const FacePart&) = delete;
    FacePart& operator=(const FacePart&) = delete;

    std::size_t size() const { return slot_.size(); }

    /// weights: one for each of the face's targets, any float (not finite counts as 0). skinned_from_mesh: of each
    /// joint of each skin, skins one after the other, as skinned_from_meshes() writes them; empty for a face without
    /// joints. Allocates nothing.
    void deform(std::span<const float> weights, NormalMethod method, std::span<const Mat4> skinned_from_mesh);

    /// Of the i-th of `vertices`, as the last deform() left it: after joints where it has any, else in its mesh's
    /// space.
    Vec3 position(std::size_t i) const { return positions_[slot_[i]]; }
    Vec3 normal(std::size_t i) const { return normals_[slot_[i]]; }
    Vec4 tangent(std::size_t i) const { return tangents_[slot_[i]]; }

private:
    /// Vertices in a row that the joints of one skin move.
    struct SkinnedRun {
        std::uint32_t first = 0, count = 0;
        std::size_t first_joint = 0;
    };
    static Face cut_out(const Face& face, std::span<const std::uint32_t> vertices, Wanted wanted,
                        std::vector<std::uint32_t>& kept, std::vector<std::uint32_t>& targets);

    std::vector<std::uint32_t> kept_;     ///< the face's vertices that the part holds, ascending
    std::vector<std::uint32_t> targets_;  ///< the face's targets that move any of them, ascending
    Face part_;
    VertexPath path_;
    Wanted wanted_;
    std::vector<std::uint32_t> slot_;  ///< of each wanted vertex, in the part
    std::vector<SkinnedRun> skinned_;
    ActivePieces active_;
    std::vector<float> weights_;
    std::vector<Vec3> positions_, normals_;
    std::vector<Vec4> tangents_;
};

/// Number of the first joint of each primitive's skin, where the joints of all skins stand one after the other in file
/// order; 0 for a primitive without one.
std::vector<std::uint32_t> first_joints(const Face& face);

/// The first node that draws a mesh; -1: none does.
std::int32_t drawing_node(const Face& face, std::uint32_t mesh);

}  // namespace blush
