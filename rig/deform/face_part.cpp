#include "rig/deform/face_part.h"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "rig/deform/deform.h"

namespace blush {
namespace {

const Primitive& primitive_of(const Face& face, std::uint32_t vertex) {
    const auto found = std::ranges::find_if(face.primitives, [vertex](const Primitive& primitive) {
        return vertex >= primitive.first_vertex && vertex - primitive.first_vertex < primitive.vertex_count;
    });
    assert(found != face.primitives.end() && "FacePart: a vertex of no primitive");
    return *found;
}

/// The vertex and its copies across seams: what NormalTopology takes as one.
void add_copies(const Face& face, const Primitive& primitive, std::uint32_t vertex, std::vector<std::uint32_t>& out) {
    for (std::uint32_t v = primitive.first_vertex; v < primitive.first_vertex + primitive.vertex_count; ++v) {
        if (face.positions[v] == face.positions[vertex] && face.normals[v] == face.normals[vertex]) out.push_back(v);
    }
}

void sort_unique(std::vector<std::uint32_t>& values) {
    std::ranges::sort(values);
    const auto rest = std::ranges::unique(values);
    values.erase(rest.begin(), rest.end());
}

bool holds(const std::vector<std::uint32_t>& sorted, std::uint32_t value) {
    return std::ranges::binary_search(sorted, value);
}

std::uint32_t slot_of(const std::vector<std::uint32_t>& kept, std::uint32_t vertex) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(kept, vertex) - kept.begin());
}

template <class Vector>
void gather(const std::vector<Vector>& from, const std::vector<std::uint32_t>& kept, std::vector<Vector>& to) {
    if (from.empty()) return;
    to.reserve(kept.size());
    for (const std::uint32_t v : kept) to.push_back(from[v]);
}

/// The part of a target that moves what is kept.
Target cut_target(const Target& target, const std::vector<std::uint32_t>& kept) {
    Target cut;
    cut.name = target.name;
    for (std::uint32_t slot = 0; slot < kept.size(); ++slot) {
        const auto found = std::ranges::lower_bound(target.vertices, kept[slot]);
        if (found == target.vertices.end() || *found != kept[slot]) continue;
        const auto i = static_cast<std::size_t>(found - target.vertices.begin());
        cut.vertices.push_back(slot);
        cut.position_deltas.push_back(target.position_deltas[i]);
        if (!target.normal_deltas.empty()) cut.normal_deltas.push_back(target.normal_deltas[i]);
        if (!target.tangent_deltas.empty()) cut.tangent_deltas.push_back(target.tangent_deltas[i]);
    }
    return cut;
}

}  // namespace

std::vector<std::uint32_t> first_joints(const Face& face) {
    std::vector<std::uint32_t> of_skin;
    std::uint32_t first = 0;
    for (const Skin& skin : face.skins) {
        of_skin.push_back(first);
        first += static_cast<std::uint32_t>(skin.joints.size());
    }
    std::vector<std::uint32_t> result;
    for (const Primitive& primitive : face.primitives) {
        const auto node = std::ranges::find_if(face.nodes, [&](const Node& candidate) {
            return candidate.mesh == static_cast<std::int32_t>(primitive.mesh) && candidate.skin >= 0;
        });
        result.push_back(node != face.nodes.end() ? of_skin[static_cast<std::size_t>(node->skin)] : 0);
    }
    return result;
}

std::int32_t drawing_node(const Face& face, std::uint32_t mesh) {
    const auto node = std::ranges::find(face.nodes, static_cast<std::int32_t>(mesh), &Node::mesh);
    return node == face.nodes.end() ? -1 : static_cast<std::int32_t>(node - face.nodes.begin());
}

Face FacePart::cut_out(const Face& face, std::span<const std::uint32_t> vertices, Wanted wanted,
                       std::vector<std::uint32_t>& kept, std::vector<std::uint32_t>& targets) {
    // Normals turn with the triangles around a vertex and around its copies, in the order of the face's own.
    std::vector<std::uint32_t> centres(vertices.begin(), vertices.end());
    std::vector<std::size_t> triangles;
    if (wanted == Wanted::directions) {
        for (const std::uint32_t v : vertices) add_copies(face, primitive_of(face, v), v, centres);
        sort_unique(centres);
        for (std::size_t i = 0; i + 2 < face.indices.size(); i += 3) {
            const bool around = holds(centres, face.indices[i]) || holds(centres, face.indices[i + 1]) ||
                                holds(centres, face.indices[i + 2]);
            if (around) triangles.push_back(i);
        }
    }
    kept = centres;
    for (const std::size_t first : triangles) {
        for (std::size_t corner = 0; corner < 3; ++corner) kept.push_back(face.indices[first + corner]);
    }
    sort_unique(kept);

    Face part;
    part.path = face.path;
    gather(face.positions, kept, part.positions);
    gather(face.normals, kept, part.normals);
    gather(face.tangents, kept, part.tangents);
    gather(face.joints, kept, part.joints);
    gather(face.joint_weights, kept, part.joint_weights);
    for (const std::size_t first : triangles) {
        for (std::size_t corner = 0; corner < 3; ++corner)
            part.indices.push_back(slot_of(kept, face.indices[first + corner]));
    }
    for (const Primitive& primitive : face.primitives) {
        const std::uint32_t first = slot_of(kept, primitive.first_vertex);
        const std::uint32_t last = slot_of(kept, primitive.first_vertex + primitive.vertex_count);
        if (first == last) continue;
        Primitive cut = primitive;
        cut.first_vertex = first;
        cut.vertex_count = last - first;
        cut.first_index = cut.index_count = 0;  // the topology takes the indices as they stand
        part.primitives.push_back(cut);
    }
    for (std::uint32_t t = 0; t < face.targets.size(); ++t) {
        Target cut = cut_target(face.targets[t], kept);
        if (cut.vertices.empty()) continue;
        targets.push_back(t);
        part.targets.push_back(std::move(cut));
    }
    return part;
}

FacePart::FacePart(const Face& face, std::span<const std::uint32_t> vertices, Wanted wanted)
    : part_(cut_out(face, vertices, wanted, kept_, targets_)),
      path_(part_),
      wanted_(wanted),
      weights_(targets_.size(), 0),
      positions_(part_.positions),
      normals_(part_.normals),
      tangents_(part_.tangents) {
    for (const std::uint32_t v : vertices) slot_.push_back(slot_of(kept_, v));
    // With every target at once the lists of active ones are as long as they get.
    std::ranges::fill(weights_, 1.0F);
    active_.build(path_.targets(), weights_);
    if (face.joints.empty()) return;
    const std::vector<std::uint32_t> first_joint = first_joints(face);
    for (const std::uint32_t v : vertices) {
        const auto primitive = static_cast<std::size_t>(&primitive_of(face, v) - face.primitives.data());
        skinned_.push_back({slot_of(kept_, v), 1, first_joint[primitive]});
    }
}

void FacePart::deform(std::span<const float> weights, NormalMethod method,
                      std::span<const glm::mat4> skinned_from_mesh) {
    for (std::size_t i = 0; i < targets_.size(); ++i) weights_[i] = weights[targets_[i]];
    active_.build(path_.targets(), weights_);
    const bool directions = wanted_ == Wanted::directions;
    VertexPath::Job job{&active_, method, positions_, {}, {}};
    if (directions) {
        job.normals = normals_;
        job.tangents = tangents_;
    } else if (!skinned_.empty()) {
        normals_ = part_.normals;  // joints turn them in place
        tangents_ = part_.tangents;
    }
    path_.add_targets({&job, 1}, path_.all_vertices());
    if (directions) {
        for (const std::uint32_t slot : slot_) path_.turn_normals({&job, 1}, {slot, slot + 1});
    }
    for (const SkinnedRun& run : skinned_) {
        const auto of = [&run](auto& values) { return std::span(values).subspan(run.first, run.count); };
        skin(of(part_.joints), of(part_.joint_weights), skinned_from_mesh.subspan(run.first_joint), of(positions_),
             of(normals_), of(tangents_));
    }
}

}  // namespace blush
