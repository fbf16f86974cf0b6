#pragma once
/// An 8-bit image as the face maker paints it.

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "rig/blood/colour_difference.h"
#include "runtime/files/image_file.h"
#include "tools/make_face/geometry.h"

namespace blush::make_face {

inline unsigned char to_byte(double x) {
    return static_cast<unsigned char>(std::lround(std::clamp(x, 0.0, 1.0) * 255));
}

inline Vec3 vec3(const std::array<double, 3>& c) { return {c[0], c[1], c[2]}; }
/// sRGB, 0 to 1, to linear.
inline Vec3 linear_srgb(const Vec3& c) { return {linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z)}; }

/// Rows from the top, channels interleaved.
struct Picture {
    int width = 0, height = 0, channels = 3;
    std::vector<unsigned char> bytes;

    Picture(int w, int h, int c, unsigned char value = 0)
        : width(w),
          height(h),
          channels(c),
          bytes(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * static_cast<std::size_t>(c), value) {}

    unsigned char* at(int x, int y) {
        return &bytes[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                      static_cast<std::size_t>(channels)];
    }
    void set(int x, int y, const Vec3& color) {
        unsigned char* texel = at(x, y);
        for (int k = 0; k < 3; ++k) texel[k] = to_byte(color[k]);
    }
};

inline std::vector<unsigned char> png(const Picture& picture) {
    return load::encode_png(static_cast<std::uint32_t>(picture.width), static_cast<std::uint32_t>(picture.height),
                            static_cast<std::uint32_t>(picture.channels), picture.bytes);
}

}  // namespace blush::make_face
