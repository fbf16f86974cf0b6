#include "rig/antialias/blend.h"

#include <array>
#include <cmath>

#include "rig/antialias/edges.h"
#include "rig/antialias/weights.h"

namespace blush {
namespace {

using glm::dvec4;

double finite(float value) {
    if (std::isnan(value)) return 0;
    return std::isinf(value) ? std::copysign(65504.0, static_cast<double>(value)) : static_cast<double>(value);
}

/// IEC 61966-2-1, odd beyond 0 so that it can be undone.
double linear_from_srgb(double c) {
    const double a = std::abs(c);
    return std::copysign(a <= 0.04045 ? a / 12.92 : std::pow((a + 0.055) / 1.055, 2.4), c);
}
double srgb_from_linear(double c) {
    const double a = std::abs(c);
    return std::copysign(a <= 0.0031308 ? 12.92 * a : 1.055 * std::pow(a, 1 / 2.4) - 0.055, c);
}

class Mixer {
public:
    explicit Mixer(const PictureMeaning& meaning)
        : decode_(meaning.blend_in_linear_light && meaning.transfer == Transfer::srgb),
          multiply_(meaning.alpha == AlphaMeaning::straight) {}

    dvec4 light_of(const glm::vec4& texel) const {
        dvec4 c(finite(texel.x), finite(texel.y), finite(texel.z), finite(texel.w));
        for (glm::length_t i = 0; i < 3; ++i) c[i] = (decode_ ? linear_from_srgb(c[i]) : c[i]) * (multiply_ ? c.w : 1);
        return c;
    }
    glm::vec4 texel_of(dvec4 c) const {
        for (glm::length_t i = 0; i < 3; ++i) {
            if (multiply_) c[i] = c.w != 0 ? c[i] / c.w : 0;
            if (decode_) c[i] = srgb_from_linear(c[i]);
        }
        return glm::vec4(c);
    }

private:
    bool decode_, multiply_;
};

}  // namespace

Pixels blend_neighbors(const Pixels& picture, const WeightMap& weights, const PictureMeaning& meaning) {
    const Mixer mixer(meaning);
    Pixels out(picture.width, picture.height);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const glm::u8vec4 own = weights.at(x, y);
            struct Side {
                int dx, dy;
                double weight;
            };
            const std::array<Side, 4> sides = {{{0, -1, own.x / 255.0},
                                                {-1, 0, own.z / 255.0},
                                                {0, 1, y + 1 < picture.height ? weights.at(x, y + 1).y / 255.0 : 0},
                                                {1, 0, x + 1 < picture.width ? weights.at(x + 1, y).w / 255.0 : 0}}};
            double sum = 0;
            for (const Side& side : sides) sum += side.weight;
            const glm::vec4& texel = picture.at(x, y);
            if (sum == 0) {
                for (glm::length_t i = 0; i < 4; ++i) out.at(x, y)[i] = static_cast<float>(finite(texel[i]));
                continue;
            }
            // (9.1) for each neighbour; a pixel of several lines takes their mean, weighted by their areas
            // (listing 9.5).
            const dvec4 here = mixer.light_of(texel);
            dvec4 mixed(0);
            for (const Side& side : sides) {
                const dvec4 there = mixer.light_of(picture.clamped(x + side.dx, y + side.dy));
                mixed += side.weight / sum * glm::mix(here, there, side.weight);
            }
            out.at(x, y) = mixer.texel_of(mixed);
        }
    }
    return out;
}

Pixels smaa(const Pixels& picture, const DepthPixels& depth, const SmaaSettings& settings,
            const PictureMeaning& meaning) {
    const EdgeMap edges = find_edges(picture, depth, settings.edges, meaning);
    return blend_neighbors(picture, smaa_weights(edges, settings), meaning);
}

Pixels mlaa(const Pixels& picture, const DepthPixels& depth, const MlaaSettings& settings,
            const PictureMeaning& meaning) {
    const EdgeMap edges = find_edges(picture, depth, settings.edges, meaning);
    return blend_neighbors(picture, mlaa_weights(edges, settings), meaning);
}

}  // namespace blush
