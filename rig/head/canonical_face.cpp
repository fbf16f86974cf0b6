#include "rig/head/canonical_face.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <queue>
#include <string_view>

#include "rig/names.h"
#include "rig/wrinkles/uv_raster.h"

namespace blush {
namespace {

constexpr float pi = 3.14159265358979F;

/// A target of any of these names, the first that the face has and that moves something.
const Target* find_target(const Face& face, std::span<const std::string_view> names) {
    std::vector<std::string> own;
    for (const Target& target : face.targets) own.push_back(target.name);
    const NameIndex index(own);
    for (const std::string_view name : names) {
        const auto found = index.find(name);
        if (found && !face.targets[*found].vertices.empty()) return &face.targets[*found];
    }
    return nullptr;
}

constexpr std::array<std::string_view, 3> left_eye_names = {"eyeBlinkLeft", "eyeSquintLeft", "eyeWideLeft"};
constexpr std::array<std::string_view, 3> right_eye_names = {"eyeBlinkRight", "eyeSquintRight", "eyeWideRight"};
constexpr std::array<std::string_view, 3> left_mouth_names = {"mouthSmileLeft", "mouthDimpleLeft", "mouthStretchLeft"};
constexpr std::array<std::string_view, 3> right_mouth_names = {"mouthSmileRight", "mouthDimpleRight",
                                                               "mouthStretchRight"};
constexpr std::array<std::string_view, 3> middle_mouth_names = {"mouthFunnel", "mouthPucker", "jawOpen"};

/// Heights on the mean face of what these targets move most: the upper lid moves in a blink, the corners of the mouth
/// and the cheek above them in a smile.
constexpr float lid_height_mm = 4, smile_height_mm = -64;

std::optional<std::uint32_t> primitive_of(const Face& face, std::uint32_t vertex) {
    for (std::uint32_t p = 0; p < face.primitives.size(); ++p) {
        const Primitive& primitive = face.primitives[p];
        if (vertex >= primitive.first_vertex && vertex - primitive.first_vertex < primitive.vertex_count) return p;
    }
    return std::nullopt;
}

/// How many vertices of each primitive a target moves.
std::vector<std::size_t> vertices_moved(const Face& face, const Target* target) {
    std::vector<std::size_t> moved(face.primitives.size(), 0);
    if (!target) return moved;
    for (std::size_t i = 0; i < target->vertices.size(); ++i) {
        if (target->position_deltas[i] == glm::vec3(0)) continue;
        if (const auto p = primitive_of(face, target->vertices[i])) ++moved[*p];
    }
    return moved;
}

/// Mean place of what a target moves within the primitives, by the square of how far: its centre, not its rim.
std::optional<glm::vec3> centre_of(const Face& face, const Target* target, std::span<const std::uint32_t> primitives) {
    if (!target) return std::nullopt;
    glm::dvec3 sum(0);
    double weights = 0;
    for (std::size_t i = 0; i < target->vertices.size(); ++i) {
        const auto p = primitive_of(face, target->vertices[i]);
        if (!p || std::ranges::find(primitives, *p) == primitives.end()) continue;
        const glm::dvec3 delta(target->position_deltas[i]);
        const double weight = glm::dot(delta, delta);
        sum += weight * glm::dvec3(face.positions[target->vertices[i]]);
        weights += weight;
    }
    if (!(weights > 0)) return std::nullopt;
    return glm::vec3(sum / weights);
}

/// Gives every texel without a value that of the nearest one with (by steps to the four neighbours).
template <class T>
void spread_to_empty(Map<T>& map, std::vector<bool> filled) {
    std::queue<std::size_t> edge;
    for (std::size_t i = 0; i < filled.size(); ++i) {
        if (filled[i]) edge.push(i);
    }
    const std::size_t width = map.width, height = map.height;
    while (!edge.empty()) {
        const std::size_t i = edge.front(), x = i % width, y = i / width;
        edge.pop();
        const auto visit = [&](bool inside, std::size_t neighbour) {
            if (!inside || filled[neighbour]) return;
            filled[neighbour] = true;
            map.values[neighbour] = map.values[i];
            edge.push(neighbour);
        };
        visit(x > 0, i - 1);
        visit(x + 1 < width, i + 1);
        visit(y > 0, i - width);
        visit(y + 1 < height, i + width);
    }
}

float cross(glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; }

}  // namespace

std::vector<std::uint32_t> skin_primitives(const Face& face) {
    const std::vector<std::size_t> lids = vertices_moved(face, find_target(face, left_eye_names));
    const Target* smile = find_target(face, left_mouth_names);
    const std::vector<std::size_t> mouth = vertices_moved(face, smile ? smile : find_target(face, middle_mouth_names));
    std::vector<std::uint32_t> both;
    for (std::uint32_t p = 0; p < face.primitives.size(); ++p) {
        if (lids[p] > 0 && mouth[p] > 0) both.push_back(p);
    }
    if (both.empty()) return both;
    // Lashes can move with both too; the skin is what the mouth moves most of, with all that shares its material.
    const std::uint32_t skin = *std::ranges::max_element(both, {}, [&](std::uint32_t p) { return mouth[p]; });
    std::erase_if(both, [&](std::uint32_t p) { return face.primitives[p].material != face.primitives[skin].material; });
    return both;
}

std::optional<FaceLandmarks> landmarks_from_targets(const Face& face, std::span<const std::uint32_t> primitives) {
    const auto left_eye = centre_of(face, find_target(face, left_eye_names), primitives);
    const auto right_eye = centre_of(face, find_target(face, right_eye_names), primitives);
    const auto left_mouth = centre_of(face, find_target(face, left_mouth_names), primitives);
    const auto right_mouth = centre_of(face, find_target(face, right_mouth_names), primitives);
    const auto middle_mouth = centre_of(face, find_target(face, middle_mouth_names), primitives);
    const bool smile = left_mouth && right_mouth;
    if (!left_eye || !right_eye || !(smile || middle_mouth)) return std::nullopt;
    FaceLandmarks landmarks;
    landmarks.left_eye = *left_eye;
    landmarks.right_eye = *right_eye;
    landmarks.mouth = smile ? (*left_mouth + *right_mouth) / 2.0F : *middle_mouth;
    landmarks.eye_height_mm = lid_height_mm;
    landmarks.mouth_height_mm = smile ? smile_height_mm : canonical_mouth_mm;
    if (!CanonicalFrame(landmarks).usable()) return std::nullopt;
    return landmarks;
}

CanonicalFrame::CanonicalFrame(const FaceLandmarks& landmarks) : eye_height_mm_(landmarks.eye_height_mm) {
    between_eyes_ = (landmarks.left_eye + landmarks.right_eye) / 2.0F;
    const glm::vec3 across = landmarks.left_eye - landmarks.right_eye;
    const float apart = glm::length(across);
    if (!(apart > 0) || !std::isfinite(apart)) return;
    left_ = across / apart;
    const glm::vec3 to_mouth = landmarks.mouth - between_eyes_;
    const glm::vec3 down = to_mouth - glm::dot(to_mouth, left_) * left_;
    const float below = glm::length(down);
    // Flatter than a tenth of the width between the eyes is no face.
    if (!(below > 0.1F * apart) || !std::isfinite(below)) return;
    up_ = -down / below;
    forward_ = glm::cross(left_, up_);
    mm_across_ = 2 * canonical_pupil_mm / apart;
    mm_up_ = (landmarks.eye_height_mm - landmarks.mouth_height_mm) / below;
    usable_ = true;
}

namespace {
/// The pupils stand on the cylinder at +-canonical_pupil_mm.
float mm_per_radian() { return canonical_pupil_mm / std::atan2(canonical_pupil_mm, canonical_axis_depth_mm); }
}  // namespace

float CanonicalFrame::turn_mm() { return 2 * pi * mm_per_radian(); }

glm::vec2 CanonicalFrame::canonical_mm(const glm::vec3& position) const {
    const glm::vec3 from_eyes = position - between_eyes_;
    const float across_mm = glm::dot(from_eyes, left_) * mm_across_;
    const float depth_mm = glm::dot(from_eyes, forward_) * mm_across_ + canonical_axis_depth_mm;
    return {std::atan2(across_mm, depth_mm) * mm_per_radian(), glm::dot(from_eyes, up_) * mm_up_ + eye_height_mm_};
}

float CanonicalFrame::radius_mm(const glm::vec3& position) const {
    const glm::vec3 from_eyes = position - between_eyes_;
    return std::hypot(glm::dot(from_eyes, left_) * mm_across_,
                      glm::dot(from_eyes, forward_) * mm_across_ + canonical_axis_depth_mm);
}

std::optional<CanonicalMap> canonical_map(const Face& face, std::span<const std::uint32_t> primitives,
                                          const CanonicalFrame& frame, std::uint32_t width, std::uint32_t height) {
    assert(frame.usable() && width > 0 && height > 0);
    std::vector<std::uint8_t> drawn(face.primitives.size(), 0);
    for (const std::uint32_t p : primitives) drawn[p] = 1;
    const UvRaster raster = rasterize_uv(face, drawn, 0, width, height);
    const std::vector<std::uint32_t> nearest = nearest_covered(raster);
    if (nearest.empty()) return std::nullopt;

    std::vector<glm::vec2> of_vertex;
    for (const glm::vec3 position : face.positions) of_vertex.push_back(frame.canonical_mm(position));
    const float turn = CanonicalFrame::turn_mm();
    CanonicalMap map{Map<glm::vec2>(width, height), ScalarMap(width, height)};
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        if (!raster.covered(i)) continue;
        const UvTexel& texel = raster.texels[i];
        const std::uint32_t* const corners = &face.indices[std::size_t{texel.triangle} * 3];
        const glm::vec2 first = of_vertex[corners[0]];
        glm::vec2 sum = texel.corner_weights[0] * first;
        for (glm::length_t k = 1; k < 3; ++k) {
            glm::vec2 corner = of_vertex[corners[k]];
            // Across the seam at the back of the head, x runs on beyond half a turn instead of jumping back.
            corner.x -= turn * std::round((corner.x - first.x) / turn);
            sum += texel.corner_weights[k] * corner;
        }
        map.canonical_mm.values[i] = sum;
        map.coverage.values[i] = 1;
    }
    for (std::size_t i = 0; i < nearest.size(); ++i) map.canonical_mm.values[i] = map.canonical_mm.values[nearest[i]];
    return map;
}

std::optional<CanonicalMap> canonical_map(const TextureLandmarks& landmarks, std::uint32_t width,
                                          std::uint32_t height) {
    const glm::vec2 middle = (landmarks.left_eye + landmarks.right_eye) / 2.0F;
    // Two directions in the texture: to the face's left by a millimetre, and up by one.
    const glm::vec2 left = (landmarks.left_eye - landmarks.right_eye) / (2 * canonical_pupil_mm);
    const glm::vec2 up = (landmarks.mouth - middle) / canonical_mouth_mm;
    const float area = cross(left, up);
    if (!std::isfinite(area) || std::abs(area) < 1e-9F)
        return std::nullopt;  // of the whole texture a square millimetre
    CanonicalMap map{Map<glm::vec2>(width, height), ScalarMap(width, height, 1)};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5F) / glm::vec2(width, height) - middle;
            map.canonical_mm.at(x, y) = {cross(uv, up) / area, cross(left, uv) / area};
        }
    }
    return map;
}

ScalarMap face_region(const CanonicalMap& map) {
    constexpr float sides_mm = 80, top_mm = 50, bottom_mm = -110;
    ScalarMap region = map.coverage;
    for (std::size_t i = 0; i < region.values.size(); ++i) {
        const glm::vec2 place = map.canonical_mm.values[i];
        if (std::abs(place.x) > sides_mm || place.y > top_mm || place.y < bottom_mm) region.values[i] = 0;
    }
    return region;
}

ScalarMap carried(const ScalarMap& values, const CanonicalMap& from, const CanonicalMap& to) {
    assert(values.same_size(from.coverage) && "carried: the map is not in the layout it comes from");
    // The mean face unrolled, from the neck to the crown, in cells of 2 mm: finer than any change of blood.
    constexpr float cell_mm = 2, low_mm = -200, high_mm = 200;
    const float turn = CanonicalFrame::turn_mm();
    const auto columns = static_cast<std::uint32_t>(std::ceil(turn / cell_mm));
    const auto rows = static_cast<std::uint32_t>((high_mm - low_mm) / cell_mm);
    const auto uv_of = [&](glm::vec2 mm) {
        const float around = mm.x / turn + 0.5F;
        return glm::vec2(around - std::floor(around), std::clamp((mm.y - low_mm) / (high_mm - low_mm), 0.0F, 0.99999F));
    };
    ScalarMap grid(columns, rows), counts(columns, rows);
    for (std::size_t i = 0; i < values.values.size(); ++i) {
        if (!(from.coverage.values[i] > 0) || !std::isfinite(values.values[i])) continue;
        const glm::vec2 uv = uv_of(from.canonical_mm.values[i]);
        const auto x = std::min(static_cast<std::uint32_t>(uv.x * static_cast<float>(columns)), columns - 1);
        const auto y = std::min(static_cast<std::uint32_t>(uv.y * static_cast<float>(rows)), rows - 1);
        grid.at(x, y) += values.values[i];
        counts.at(x, y) += 1;
    }
    std::vector<bool> filled(grid.values.size());
    for (std::size_t i = 0; i < filled.size(); ++i) {
        filled[i] = counts.values[i] > 0;
        if (filled[i]) grid.values[i] /= counts.values[i];
    }
    spread_to_empty(grid, std::move(filled));
    ScalarMap result(to.coverage.width, to.coverage.height);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        result.values[i] = sample(grid, uv_of(to.canonical_mm.values[i]));
    }
    return result;
}

}  // namespace blush
