#pragma once
/// A surface as modelling programs exchange it: polygons over one numbering of vertices, which an importer needs to
/// keep (morphs and attached parts name vertices by it).

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "runtime/files/bytes.h"

namespace blush::load {

struct Polygons {
    struct Corner {
        std::uint32_t vertex, uv;  ///< uv == no_uv: none
    };
    struct Polygon {
        std::uint32_t first_corner, corner_count, part;
    };
    static constexpr std::uint32_t no_uv = 0xFFFFFFFF;

    std::vector<glm::dvec3> positions;  ///< as the file's decimals say
    std::vector<glm::vec2> uv;          ///< v grows downward, as glTF has it
    std::vector<Corner> corners;
    std::vector<Polygon> polygons;   ///< 3 corners or more
    std::vector<std::string> parts;  ///< names by usemtl or g; "" before the first
};

enum class PartsBy : std::uint8_t { material, group };

/// Reads the v, vt and f statements of an OBJ file; negative indices and joined lines are refused, since no head that
/// is imported has them. `place` names the file. Throws BadFile with the line.
Polygons read_polygons(ByteView obj, PartsBy parts_by, std::string_view place);

/// The positions alone, and how many faces follow: what an expression of a known head needs. `faces_hash` tells face
/// statements apart (FNV-1a over their characters).
struct ObjPositions {
    std::vector<glm::dvec3> positions;
    std::uint64_t faces_hash = 0;
};
ObjPositions read_positions(ByteView obj, std::string_view place);

}  // namespace blush::load
