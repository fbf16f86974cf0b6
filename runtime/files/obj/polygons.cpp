#include "runtime/files/obj/polygons.h"

#include <algorithm>

#include "runtime/files/text_lines.h"

namespace blush::load {
namespace {

/// Faces may name what comes after them, so all statements are counted before.
struct Counts {
    std::size_t vertices = 0, uvs = 0;
};

Counts count(ByteView obj) {
    Counts counts;
    for (TextLines lines(obj, ""); lines.next_line();) {
        const std::string_view keyword = lines.word();
        if (keyword == "v") ++counts.vertices;
        if (keyword == "vt") ++counts.uvs;
    }
    return counts;
}

glm::dvec3 position(TextLines& lines) {
    const double x = lines.number(), y = lines.number();
    return {x, y, lines.number()};
}

Polygons::Corner corner(const TextLines& lines, std::string_view text, const Counts& counts) {
    const auto index = [&](std::string_view part, std::size_t count, std::string_view what) {
        return static_cast<std::uint32_t>(lines.index_in(part, 1, count, what));
    };
    const std::size_t slash = text.find('/');
    Polygons::Corner result{index(text.substr(0, slash), counts.vertices, "vertex"), Polygons::no_uv};
    if (slash == std::string_view::npos) return result;
    const std::string_view uv = text.substr(slash + 1, text.find('/', slash + 1) - slash - 1);
    if (!uv.empty()) result.uv = index(uv, counts.uvs, "texture coordinate");
    return result;
}

}  // namespace

Polygons read_polygons(ByteView obj, PartsBy parts_by, std::string_view place) {
    const Counts counts = count(obj);
    const std::string_view part_keyword = parts_by == PartsBy::material ? "usemtl" : "g";
    Polygons result;
    result.parts.emplace_back();
    std::uint32_t part = 0;
    for (TextLines lines(obj, place); lines.next_line();) {
        const std::string_view keyword = lines.word();
        if (keyword == "v") {
            result.positions.push_back(position(lines));
        } else if (keyword == "vt") {
            const double u = lines.number();
            result.uv.emplace_back(u, 1 - lines.number());
        } else if (keyword == "f") {
            const auto first = static_cast<std::uint32_t>(result.corners.size());
            for (std::string_view text = lines.word(); !text.empty(); text = lines.word())
                result.corners.push_back(corner(lines, text, counts));
            const auto size = static_cast<std::uint32_t>(result.corners.size()) - first;
            if (size < 3) lines.bad_line("a face has fewer than three corners");
            result.polygons.push_back({first, size, part});
        } else if (keyword == part_keyword) {
            const std::string_view name = lines.word();
            const auto found = std::ranges::find(result.parts, name);
            part = static_cast<std::uint32_t>(found - result.parts.begin());
            if (found == result.parts.end()) result.parts.emplace_back(name);
        }
    }
    if (result.polygons.empty()) refuse(place, "the file has no faces (statements v and f)");
    return result;
}

ObjPositions read_positions(ByteView obj, std::string_view place) {
    constexpr std::uint64_t fnv_basis = 14695981039346656037ULL, fnv_prime = 1099511628211ULL;
    ObjPositions result;
    result.faces_hash = fnv_basis;
    for (TextLines lines(obj, place); lines.next_line();) {
        const std::string_view keyword = lines.word();
        if (keyword == "v") {
            result.positions.push_back(position(lines));
        } else if (keyword == "f") {
            for (const char c : lines.rest())
                result.faces_hash = (result.faces_hash ^ static_cast<unsigned char>(c)) * fnv_prime;
        }
    }
    return result;
}

}  // namespace blush::load
