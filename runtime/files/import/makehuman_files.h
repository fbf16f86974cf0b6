#pragma once
/// MakeHuman's own text formats: morphs (.target) and how a part sits on the base mesh (.mhclo).

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "runtime/files/bytes.h"

namespace blush::load {

/// A morph: lines "vertex dx dy dz", decimetres. A vertex that is named twice moves by the sum.
struct Morph {
    std::string name;
    std::vector<std::uint32_t> vertices;
    std::vector<glm::dvec3> deltas;
};

/// Throws BadFile with the line where a vertex is beyond `vertex_count` or a number is none.
Morph read_morph(ByteView text, std::size_t vertex_count, std::string name, std::string_view place);

/// positions += weight * morph.
void apply(const Morph& morph, double weight, std::span<glm::dvec3> positions);

/// Where the vertices of a part lie on the base mesh. Each is either a vertex of the base mesh, or the weighted mean of
/// three with an offset, whose axes grow with a distance on the base mesh ("x_scale a b at_rest").
struct Fitting {
    struct Anchor {
        std::array<std::uint32_t, 3> vertices;
        glm::dvec3 weights, offset;
    };
    struct Scale {
        std::uint32_t from = 0, to = 0;
        double distance = 0;  ///< at which an offset counts as it is; 0: always
    };
    std::vector<Anchor> anchors;
    std::array<Scale, 3> scales;  ///< x, y, z

    /// How far the offsets' axes grow on a base mesh of this shape.
    glm::dvec3 growth(std::span<const glm::dvec3> base) const;
    /// The part's vertices on a base mesh of any shape. An expression moves a part but does not make it grow, so its
    /// `growth` is that of the base mesh at rest (an open jaw would else stretch the teeth that measure it).
    std::vector<glm::dvec3> fit(std::span<const glm::dvec3> base, const glm::dvec3& growth) const;
};

Fitting read_fitting(ByteView text, std::size_t base_vertex_count, std::string_view place);

}  // namespace blush::load
