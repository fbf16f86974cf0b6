#pragma once
/// The deformation of a face by transform feedback (jimenez-2012, 7.6 and 8.3: "we store a set of
/// transformed vertices into a buffer"). The GPU twin of rig/deform/deform.h.

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "rig/deform/blend_shapes.h"
#include "rig/deform/surface_normals.h"
#include "rig/face.h"
#include "rig/result.h"
#include "runtime/device.h"
#include "runtime/gl/object.h"
#include "runtime/gl/program.h"

namespace blush {

/// Positions (3 floats a vertex), normals (3) and tangents (4) of a whole face, tightly packed.
struct SurfaceBuffers {
    gl::Buffer positions, normals, tangents;
};

/// What deforming a face needs that every character of it shares: the surface at rest, the targets' deltas, joints.
class DeformModel {
public:
    /// `face` must outlive the object. largest_block_bytes: deltas beyond it go into several pages; 0: what the device
    /// takes in one storage block. Error: one target alone moves more vertices than a block holds.
    static Result<std::shared_ptr<DeformModel>> create(const Device& device, const Face& face,
                                                       std::uint64_t largest_block_bytes = 0);

    const Face& face() const { return *face_; }
    const SurfaceBuffers& rest() const { return rest_; }

private:
    friend class StreamOut;
    /// A run of primitives that targets move and whose normals come from the same place.
    struct Range {
        std::uint32_t first = 0, count = 0;
        bool recomputed = false;
    };
    struct Page {
        std::uint32_t first_target = 0, last_target = 0;
        std::uint32_t first_delta = 0;
        gl::Buffer positions, normals, tangents;
    };

    explicit DeformModel(const Face& face) : face_(&face) {}
    Status build(std::uint64_t largest_block_bytes, const std::string& renderer);
    Status build_pages(std::uint64_t largest_block_bytes, const std::string& renderer);
    std::vector<Range> ranges(NormalMethod method) const;
    void bind_source(const SurfaceBuffers& source);
    void stream(const Range& range, const SurfaceBuffers& destination);
    SurfaceBuffers& scratch(std::size_t index);
    SurfaceBuffers make_surface() const;
    gl::Buffer& dense_target(std::uint32_t target);
    void begin(const gl::Program& program);
    void ensure_topology();

    const Face* face_;
    std::vector<Range> moved_ranges_, moved_ranges_recomputed_;
    bool has_normal_deltas_ = false, has_tangent_deltas_ = false;

    SurfaceBuffers rest_;
    SurfaceBuffers scratch_[2];  // of the character that is being deformed
    std::unique_ptr<SparseBlocks> sparse_;
    std::vector<Page> pages_;
    BlockLists lists_;  // of the character whose active targets change
    std::map<std::uint32_t, gl::Buffer> dense_targets_;

    gl::Buffer first_triangle_, triangles_, rest_sums_;
    gl::Buffer joint_indices_, joint_weights_;
    std::vector<std::uint32_t> first_joint_of_primitive_;

    gl::Program sparse_program_, pass_program_, normals_program_, skin_program_;
    gl::VertexArray vertex_array_, normals_vertex_array_;
    gl::TransformFeedback feedback_;
    gl::Framebuffer no_attachments_;
};

/// One character's deformed surface.
class StreamOut {
public:
    explicit StreamOut(std::shared_ptr<DeformModel> model);

    const SurfaceBuffers& rest() const { return model_->rest_; }
    /// Makes deformed(), at rest, where it is not there yet.
    void prepare();
    /// Empty handles until prepare().
    const SurfaceBuffers& deformed() const { return deformed_; }
    const SurfaceBuffers& skinned() const { return skinned_; }

    /// Uploads the weights, and the lists of active targets where the set of them changed. A weight that is not finite
    /// is the caller's to prevent.
    void set_active(std::span<const ActiveTarget> active);

    /// Sparse deltas of all active targets in one pass (one a page of deltas, where they exceed a storage block).
    /// With no active target it streams out the rest surface.
    void add_targets_sparse(NormalMethod method);
    /// The paper's scheme: passes of four dense targets each (three where targets have tangents).
    void add_targets_in_passes(NormalMethod method);
    /// Turns the normals of the primitives that need it with the deformed surface. After one of the above.
    void turn_normals(NormalMethod method);
    /// Joints, from `source` into skinned(). One matrix a joint, skins one after the other in file order.
    void skin(const SurfaceBuffers& source, std::span<const glm::mat4> skinned_from_mesh);

    /// Work of the last add_targets_*: passes, and deltas added up.
    struct Work {
        std::uint32_t passes = 0;
        std::uint64_t deltas = 0;
    };
    Work last_work() const { return work_; }

private:
    using Range = DeformModel::Range;
    struct ActiveList {  // of one page of the model
        gl::Buffer first_entry, entries;
        std::size_t entry_capacity = 0;
        std::uint64_t deltas = 0;
    };

    std::shared_ptr<DeformModel> model_;
    SurfaceBuffers deformed_, skinned_;
    std::vector<ActiveList> lists_;
    bool lists_built_ = false;
    std::vector<ActiveTarget> active_;
    std::vector<float> active_weights_;
    gl::Buffer weights_;
    std::size_t weights_capacity_ = 0;
    gl::Buffer joints_;
    std::size_t joints_capacity_ = 0;
    Work work_;
};

}  // namespace blush
