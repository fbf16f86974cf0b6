#include "tests/bench/coverage_frames.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <glm/gtc/matrix_transform.hpp>

#include "rig/deform/rest_frame.h"

namespace blush {
namespace {

constexpr float pitch_pixels = coverage_side_pixels + 16;
constexpr std::size_t columns = 64;

template <class T>
T must(Result<T> result) {
    if (result) return *std::move(result);
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::exit(2);
}

double linear_from_srgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

}  // namespace

CoverageFrames::CoverageFrames(const Device& device, std::vector<CoverageShape> shapes, float radiance)
    : device_(device), shapes_(std::move(shapes)), radiance_(radiance) {
    constexpr double edge = coverage_side_pixels;
    shapes_.push_back({"full", {{{0, 0}, {edge, 0}, {edge, edge}, {0, edge}}}, 0});
    constexpr auto side = static_cast<std::uint32_t>(coverage_side_pixels);
    for (const Output output : {Output::display_srgb, Output::linear_hdr}) {
        offscreens_.push_back(must(Offscreen::create(device, side, side, output)));
    }
}

/// Upper left corner of a shape's picture in the plane that holds them all, y up.
glm::vec2 CoverageFrames::corner_of(std::size_t shape) const {
    return pitch_pixels * glm::vec2(static_cast<float>(shape % columns), -static_cast<float>(shape / columns));
}

/// One pixel is one unit.
Face CoverageFrames::face() const {
    Face face;
    face.path = "coverage shapes";
    for (std::size_t s = 0; s < shapes_.size(); ++s) {
        for (const Polygon& polygon : shapes_[s].polygons) {
            const auto first = static_cast<std::uint32_t>(face.positions.size());
            for (const glm::dvec2 corner : polygon) {
                const glm::vec2 at = corner_of(s) + glm::vec2(corner.x, -corner.y);
                face.positions.emplace_back(at, 0);
            }
            const auto last = static_cast<std::uint32_t>(face.positions.size());
            for (std::uint32_t v = first + 2; v < last; ++v) face.indices.insert(face.indices.end(), {first, v - 1, v});
        }
    }
    const std::size_t count = face.positions.size();
    face.normals.assign(count, glm::vec3(0, 0, 1));
    face.tangents.assign(count, glm::vec4(1, 0, 0, 1));
    face.uv0.assign(count, glm::vec2(0));
    face.uv1.assign(count, glm::vec2(0));
    Material glow;
    glow.skin = false;  // light neither scatters in it nor shines through
    glow.base_color_linear = {0, 0, 0, 1};
    glow.metallic = 1;
    glow.roughness = 1;
    glow.emissive_linear = glm::vec3(radiance_);
    glow.double_sided = true;
    face.materials = {glow};
    Primitive primitive;
    primitive.vertex_count = static_cast<std::uint32_t>(count);
    primitive.index_count = static_cast<std::uint32_t>(face.indices.size());
    primitive.material = 0;
    face.primitives = {primitive};
    face.meshes = {{"shapes", 0, 1}};
    Node node;
    node.mesh = 0;
    face.nodes = {node};
    return face;
}

std::size_t CoverageFrames::add(const Mode& mode) {
    drawn_.push_back({must(Portrait::create(device_, face())), mode.output, 1});
    for (const auto& [setting, choice] : mode.settings) {
        if (const Status done = drawn_.back().character.set(setting, choice); !done) {
            std::fprintf(stderr, "%s\n", done.error().message.c_str());
            std::exit(2);
        }
    }
    const std::size_t number = drawn_.size() - 1;
    drawn_[number].full = show(number, shapes_.size() - 1).at(coverage_side_pixels / 2, coverage_side_pixels / 2);
    return number;
}

ViewFrame CoverageFrames::view_of(std::size_t shape, Output output, glm::dvec2 offset_pixels) const {
    // Far away, so that every point is seen from the front: at a grazing angle even a black surface reflects.
    constexpr float half = 0.5F * coverage_side_pixels, distance = 1e4F;
    const glm::vec2 middle = corner_of(shape) + glm::vec2(half, -half) +
                             glm::vec2(static_cast<float>(offset_pixels.x), -static_cast<float>(offset_pixels.y));
    ViewFrame view = offscreens_[output == Output::display_srgb ? 0 : 1].view();
    view.camera.view_from_world = glm::translate(glm::mat4(1), glm::vec3(-middle, -distance));
    view.camera.clip_from_view = glm::ortho(-half, half, -half, half, 0.5F * distance, 2 * distance);
    view.background_linear = {0, 0, 0, 1};
    return view;
}

Grid<double> CoverageFrames::show(std::size_t mode, std::size_t shape, glm::dvec2 offset_pixels) {
    Drawn& drawn = drawn_[mode];
    ViewFrame view = view_of(shape, drawn.output, offset_pixels);
    view.cut = true;
    const bool incomplete = drawn.character.draw(view).incomplete;
    view.cut = false;
    if (incomplete) drawn.character.draw(view);
    const Image image = offscreens_[drawn.output == Output::display_srgb ? 0 : 1].read();
    Grid<double> shares(coverage_side_pixels, coverage_side_pixels, 0.0);
    for (std::size_t p = 0; p < shares.cells.size(); ++p) {
        const double light = image.bytes.empty() ? static_cast<double>(image.floats[4 * p])
                                                 : linear_from_srgb(image.bytes[4 * p] / 255.0);
        shares.cells[p] = light / drawn.full;
    }
    return shares;
}

}  // namespace blush
