#include "rig/antialias/edges.h"

#include <cassert>
#include <cmath>

namespace blush {
namespace {

/// Contrasts that differ by less are one: drivers convert bytes to floats with different last bits, and a comparison of
/// two equal contrasts must not depend on them. 8-bit steps are 4000 times larger.
constexpr float same_contrast = 1e-6F;

/// False for NaN, which counts as 0.
float clean(float value) { return value > 0 ? std::min(value, 65504.0F) : 0; }

/// What differences are taken of: luma or colour as a display shows it, coverage, depth. Contrast is the largest
/// difference of a component.
class Signal {
public:
    Signal(const Pixels& picture, const DepthPixels& depth, const EdgeSettings& settings, const PictureMeaning& meaning)
        : picture_(picture), depth_(depth), source_(settings.source), meaning_(meaning) {}

    float contrast(int x, int y, int other_x, int other_y) const {
        const glm::vec4 difference = glm::abs(at(x, y) - at(other_x, other_y));
        return std::max(std::max(difference.x, difference.y), std::max(difference.z, difference.w));
    }
    float depth_contrast(int x, int y, int other_x, int other_y) const {
        return std::abs(clean(depth_.clamped(x, y)) - clean(depth_.clamped(other_x, other_y)));
    }

private:
    glm::vec4 at(int x, int y) const {
        if (source_ == EdgeSource::depth) return {clean(depth_.clamped(x, y)), 0, 0, 0};
        const glm::vec4& texel = picture_.clamped(x, y);
        const float alpha = std::min(clean(texel.w), 1.0F);
        const auto shown = [&](float channel) {
            float value = clean(channel);
            if (meaning_.alpha == AlphaMeaning::straight) value *= alpha;
            // The square root stands for the sRGB curve: within 0.03 of it, and the same bits on CPU and GPU.
            return meaning_.transfer == Transfer::linear ? std::sqrt(value) : value;
        };
        const float coverage = meaning_.alpha == AlphaMeaning::carried ? 0 : alpha;
        const float r = shown(texel.x), g = shown(texel.y), b = shown(texel.z);
        if (source_ == EdgeSource::color) return {r, g, b, coverage};
        return {0.2126F * r + 0.7152F * g + 0.0722F * b, 0, 0, coverage};  // (9.2)
    }

    const Pixels& picture_;
    const DepthPixels& depth_;
    EdgeSource source_;
    PictureMeaning meaning_;
};

}  // namespace

EdgeMap find_edges(const Pixels& picture, const DepthPixels& depth, const EdgeSettings& settings,
                   const PictureMeaning& meaning) {
    const bool from_depth = settings.source == EdgeSource::depth;
    assert((!from_depth && !settings.predication.on) ||
           (depth.width == picture.width && depth.height == picture.height));
    const Signal signal(picture, depth, settings, meaning);
    const auto threshold = [&](int x, int y, int other_x, int other_y) {
        if (from_depth) return settings.depth_threshold;
        if (!settings.predication.on) return settings.threshold;
        const bool silhouette = signal.depth_contrast(x, y, other_x, other_y) > settings.predication.depth_threshold;
        return settings.threshold * settings.predication.scale *
               (1 - (silhouette ? settings.predication.strength : 0.0F));
    };
    const auto is_edge = [&](float contrast, float beyond, float greatest) {
        return contrast - beyond > same_contrast &&
               (from_depth || contrast - settings.contrast_factor * greatest > same_contrast);  // (10.1)
    };
    EdgeMap edges(picture.width, picture.height);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            // Out of the picture, the border goes on: no contrast there.
            const float left = signal.contrast(x, y, x - 1, y), right = signal.contrast(x, y, x + 1, y);
            const float top = signal.contrast(x, y, x, y - 1), bottom = signal.contrast(x, y, x, y + 1);
            const float around = std::max(std::max(left, right), std::max(top, bottom));
            const float left_of_left = signal.contrast(x - 1, y, x - 2, y);
            const float top_of_top = signal.contrast(x, y - 1, x, y - 2);
            edges.at(x, y) = {is_edge(left, threshold(x, y, x - 1, y), std::max(around, left_of_left)),
                              is_edge(top, threshold(x, y, x, y - 1), std::max(around, top_of_top))};
        }
    }
    return edges;
}

}  // namespace blush
