#include "rig/wrinkles/wrinkle_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rig/wrinkles/derivative_map.h"

namespace blush {
namespace {

constexpr double pi = 3.14159265358979;
constexpr double patch_mm = 60, radius_mm = 90, pore_mm = 1.3, pore_depth_mm = 0.02, fold_mm = 8;

struct Skin {
    double fold_depth_mm = 0;

    double pores(glm::dvec2 at) const {
        return pore_depth_mm * std::cos(2 * pi / pore_mm * at.x) * std::cos(2 * pi / pore_mm * at.y);
    }
    double folds(glm::dvec2 at) const {
        // Bent a little, so that every direction of a fold occurs.
        return fold_depth_mm * std::sin(2 * pi / fold_mm * (at.y + 4 * std::sin(at.x / 12)));
    }
};

/// Height and its slope, by central differences over a step far below a pore.
template <class Height>
glm::dvec2 slope(Height height, glm::dvec2 at) {
    constexpr double step = 1e-4;
    return {(height(at + glm::dvec2(step, 0)) - height(at - glm::dvec2(step, 0))) / (2 * step),
            (height(at + glm::dvec2(0, step)) - height(at - glm::dvec2(0, step))) / (2 * step)};
}

/// Frame of the sphere at a point of the patch, which covers it by arc length along two great circles.
struct Frame {
    glm::dvec3 normal, tangent, bitangent;
};
glm::dvec3 normal_at(glm::dvec2 at) {
    const double a = at.x / radius_mm, b = at.y / radius_mm;
    return {std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b)};
}
Frame frame_at(glm::dvec2 at) {
    const double a = at.x / radius_mm, b = at.y / radius_mm;
    const glm::dvec3 tangent(std::cos(a), 0, -std::sin(a));
    return {normal_at(at), tangent, {-std::sin(a) * std::sin(b), std::cos(b), -std::cos(a) * std::sin(b)}};
}

glm::dvec3 true_normal(const Skin& skin, double weight, glm::dvec2 at) {
    const auto point = [&](glm::dvec2 p) {
        return normal_at(p) * (radius_mm + skin.pores(p) + weight * skin.folds(p));
    };
    constexpr double step = 1e-4;
    const glm::dvec3 along_x = point(at + glm::dvec2(step, 0)) - point(at - glm::dvec2(step, 0));
    const glm::dvec3 along_y = point(at + glm::dvec2(0, step)) - point(at - glm::dvec2(0, step));
    return glm::normalize(glm::cross(along_x, along_y));
}

float stored(float value, const WrinkleErrorCase& of, float range) {
    if (!of.eight_bits) return std::clamp(value, -range, range);
    return derivative_from_stored(stored_derivative(value, range), range);
}

/// A map of the patch; texel centres as in GL.
template <class Texel>
struct PatchMap {
    std::uint32_t side;
    std::vector<Texel> texels;

    template <class Make>
    PatchMap(std::uint32_t of_side, Make make) : side(of_side) {
        texels.reserve(std::size_t{side} * side);
        for (std::uint32_t i = 0; i < side * side; ++i)
            texels.push_back(
                make((glm::dvec2(i % side, i / side) + 0.5) / static_cast<double>(side) * patch_mm - patch_mm / 2));
    }
    Texel bilinear(glm::dvec2 at) const {
        const glm::dvec2 place = (at + patch_mm / 2) / patch_mm * static_cast<double>(side) - 0.5;
        const glm::dvec2 low = glm::clamp(glm::floor(place), 0.0, static_cast<double>(side) - 2);
        const glm::vec2 f(place - low);
        const auto i = static_cast<std::size_t>(low.y) * side + static_cast<std::size_t>(low.x);
        return glm::mix(glm::mix(texels[i], texels[i + 1], f.x), glm::mix(texels[i + side], texels[i + side + 1], f.x),
                        f.y);
    }
};

}  // namespace

NormalError wrinkle_normal_error(const WrinkleErrorCase& of) {
    const Skin skin{std::tan(of.steepest_degrees * pi / 180) * fold_mm / (2 * pi)};
    const auto pores = [&](glm::dvec2 at) { return skin.pores(at); };
    const auto folds = [&](glm::dvec2 at) { return skin.folds(at); };
    const auto both = [&](glm::dvec2 at) { return skin.pores(at) + skin.folds(at); };
    const auto normal_of = [](glm::dvec2 rise) { return glm::vec3(glm::normalize(glm::dvec3(-rise, 1))); };
    const auto stored_derivatives = [&](glm::vec3 normal) {
        const glm::vec2 derivative = derivative_from_normal(normal, of.range);
        return glm::vec2(stored(derivative.x, of, of.range), stored(derivative.y, of, of.range));
    };
    const auto stored_normal = [&](glm::vec3 n) {
        return glm::vec3(stored(n.x, of, 1), stored(n.y, of, 1), stored(n.z, of, 1));
    };

    const bool derivatives = of.encoding == WrinkleEncoding::derivatives;
    const PatchMap<glm::vec2> base_derivatives(
        derivatives ? of.base_side : 2, [&](glm::dvec2 at) { return stored_derivatives(normal_of(slope(pores, at))); });
    const PatchMap<glm::vec2> wrinkle_derivatives(
        derivatives ? of.map_side : 2, [&](glm::dvec2 at) { return stored_derivatives(normal_of(slope(folds, at))); });
    const PatchMap<glm::vec3> base_normals(derivatives ? 2 : of.base_side,
                                           [&](glm::dvec2 at) { return stored_normal(normal_of(slope(pores, at))); });
    // A wrinkle map as an artist has it holds the pores too, as far as its texels show them (8.2.1, figure 8.4).
    const PatchMap<glm::vec3> wrinkle_differences(derivatives ? 2 : of.map_side, [&](glm::dvec2 at) {
        return stored_normal(normal_difference(normal_of(slope(both, at)), normal_of(slope(pores, at))));
    });

    std::vector<double> errors;
    constexpr int points = 80;  // a side; 0.7 mm apart, with a fraction that drifts through pores and texels
    for (int i = 0; i < points * points; ++i) {
        const glm::dvec2 at =
            (glm::dvec2(i % points, i / points) / static_cast<double>(points) - 0.5) * (patch_mm * 0.949);
        glm::vec3 n;
        if (derivatives) {
            n = normal_from_derivative(base_derivatives.bilinear(at) +
                                       static_cast<float>(of.weight) * wrinkle_derivatives.bilinear(at));
        } else {
            n = add_normal_difference(glm::normalize(base_normals.bilinear(at)), wrinkle_differences.bilinear(at),
                                      static_cast<float>(of.weight));
        }
        const Frame frame = frame_at(at);
        const glm::dvec3 shaded =
            glm::normalize(frame.tangent * static_cast<double>(n.x) + frame.bitangent * static_cast<double>(n.y) +
                           frame.normal * static_cast<double>(n.z));
        const glm::dvec3 truth = true_normal(skin, of.weight, at);
        errors.push_back(std::atan2(glm::length(glm::cross(shaded, truth)), glm::dot(shaded, truth)) * 180 / pi);
    }
    NormalError result;
    for (const double error : errors) result.mean_degrees += error / static_cast<double>(errors.size());
    std::ranges::sort(errors);
    result.percentile99_degrees = errors[errors.size() * 99 / 100];
    result.worst_degrees = errors.back();
    return result;
}

}  // namespace blush
