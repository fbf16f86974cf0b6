#include "runtime/files/import/makehuman_files.h"

#include <cmath>

#include "runtime/files/text_lines.h"

namespace blush::load {
namespace {

std::uint32_t vertex(const TextLines& lines, std::string_view text, std::size_t count) {
    return static_cast<std::uint32_t>(lines.index_in(text, 0, count, "vertex"));
}

glm::dvec3 vector(TextLines& lines) {
    const double x = lines.number(), y = lines.number();
    return {x, y, lines.number()};
}

}  // namespace

Morph read_morph(ByteView text, std::size_t vertex_count, std::string name, std::string_view place) {
    Morph morph;
    morph.name = std::move(name);
    for (TextLines lines(text, place); lines.next_line();) {
        const std::string_view first = lines.word();
        if (first.empty() || first.starts_with('#')) continue;
        morph.vertices.push_back(vertex(lines, first, vertex_count));
        morph.deltas.push_back(vector(lines));
    }
    return morph;
}

void apply(const Morph& morph, double weight, std::span<glm::dvec3> positions) {
    for (std::size_t i = 0; i < morph.vertices.size(); ++i) positions[morph.vertices[i]] += weight * morph.deltas[i];
}

Fitting read_fitting(ByteView text, std::size_t base_vertex_count, std::string_view place) {
    Fitting fitting;
    bool in_vertices = false;
    for (TextLines lines(text, place); lines.next_line();) {
        const std::string_view first = lines.word();
        if (first.empty() || first.starts_with('#')) continue;
        if (first == "verts") {
            in_vertices = true;
        } else if (first == "x_scale" || first == "y_scale" || first == "z_scale") {
            Fitting::Scale& scale = fitting.scales[static_cast<std::size_t>(first.front() - 'x')];
            scale.from = vertex(lines, lines.word(), base_vertex_count);
            scale.to = vertex(lines, lines.word(), base_vertex_count);
            scale.distance = lines.number();
            if (!(scale.distance > 0)) lines.bad_line("the distance of a scale is not above zero");
        } else if (first.front() < '0' || first.front() > '9') {
            in_vertices = false;  // "delete_verts" and other lists may follow
        } else if (in_vertices) {
            const std::uint32_t a = vertex(lines, first, base_vertex_count);
            const std::string_view second = lines.word();
            if (second.empty()) {
                fitting.anchors.push_back({{a, a, a}, {1, 0, 0}, glm::dvec3(0)});
                continue;
            }
            const std::uint32_t b = vertex(lines, second, base_vertex_count);
            const std::uint32_t c = vertex(lines, lines.word(), base_vertex_count);
            const glm::dvec3 weights = vector(lines);
            fitting.anchors.push_back({{a, b, c}, weights, vector(lines)});
        }
    }
    return fitting;
}

glm::dvec3 Fitting::growth(std::span<const glm::dvec3> base) const {
    glm::dvec3 growth(1);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const Scale& scale = scales[static_cast<std::size_t>(axis)];
        if (scale.distance > 0) growth[axis] = std::abs(base[scale.from][axis] - base[scale.to][axis]) / scale.distance;
    }
    return growth;
}

std::vector<glm::dvec3> Fitting::fit(std::span<const glm::dvec3> base, const glm::dvec3& growth) const {
    std::vector<glm::dvec3> positions;
    positions.reserve(anchors.size());
    for (const Anchor& anchor : anchors) {
        glm::dvec3 position = anchor.offset * growth;
        for (glm::length_t k = 0; k < 3; ++k)
            position += anchor.weights[k] * base[anchor.vertices[static_cast<std::size_t>(k)]];
        positions.push_back(position);
    }
    return positions;
}

}  // namespace blush::load
