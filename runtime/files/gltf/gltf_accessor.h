#pragma once
/// Reading accessors (glTF 2.0, 3.6.2): sparse ones, normalised integers, and every range checked against real bytes
/// before anything is allocated. All values are finite afterwards.

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/files/gltf/gltf_document.h"

namespace blush::load {

/// What the reader of an accessor expects. `place` names it in messages.
struct AccessorUse {
    std::size_t accessor = 0;
    std::string place;
    int components = 1;                     ///< 1 to 4, or 16
    std::optional<std::size_t> count = {};  ///< elements, where the use prescribes them
};

/// `components` floats an element. Integers are divided by their largest value where the accessor is normalised
/// (glTF 2.0, 3.11: signed ones clamp at -1), else converted. Throws BadFile.
std::vector<float> read_floats(GltfDocument& document, const AccessorUse& use);

/// Elements of three floats that are not zero, ascending. An accessor that is only sparse is never expanded.
struct SparseVectors {
    std::vector<std::uint32_t> elements;
    std::vector<glm::vec3> values;
};
SparseVectors read_sparse_vectors(GltfDocument& document, const AccessorUse& use);

/// Unsigned integers of 1, 2 or 4 bytes, `components` an element. Throws BadFile.
std::vector<std::uint32_t> read_unsigned(GltfDocument& document, const AccessorUse& use);

/// The number of elements that the accessor states.
std::size_t element_count(const GltfDocument& document, std::size_t accessor);

}  // namespace blush::load
