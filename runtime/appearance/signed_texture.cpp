#include "runtime/appearance/signed_texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <epoxy/gl.h>

#include "rig/wrinkles/rgtc.h"

namespace blush {
namespace {

Map<glm::vec3> halved(const Map<glm::vec3>& map) {
    const std::uint32_t width = std::max(map.width / 2, 1U), height = std::max(map.height / 2, 1U);
    if (map.width % 2 != 0 || map.height % 2 != 0) return resized(map, width, height);
    Map<glm::vec3> half(width, height);
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x)
            half.at(x, y) = 0.25F * (map.at(2 * x, 2 * y) + map.at(2 * x + 1, 2 * y) + map.at(2 * x, 2 * y + 1) +
                                     map.at(2 * x + 1, 2 * y + 1));
    }
    return half;
}

template <class Number, class Stored>
std::vector<Number> interleaved(const Map<glm::vec3>& map, std::size_t channels, Stored stored) {
    std::vector<Number> numbers;
    numbers.reserve(map.values.size() * channels);
    for (const glm::vec3& texel : map.values) {
        for (std::size_t c = 0; c < channels; ++c) numbers.push_back(stored(texel[static_cast<glm::length_t>(c)]));
    }
    return numbers;
}

}  // namespace

gl::Texture make_signed_texture(GLenum format, Map<glm::vec3> map, std::size_t channels) {
    const bool floats = format == GL_RG16F || format == GL_RGB16F;
    const GLenum components = channels == 2 ? GL_RG : GL_RGB;
    const int levels = 1 + static_cast<int>(std::log2(std::max({map.width, map.height, 1U})));
    gl::Texture texture = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.name(), levels, format, static_cast<GLsizei>(map.width),
                       static_cast<GLsizei>(map.height));
    glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);  // rows of two or three bytes a texel need not end on four bytes
    for (int level = 0; level < levels; ++level) {
        if (level > 0) map = halved(map);
        const auto upload = [&](GLenum type, const void* texels) {
            glTextureSubImage2D(texture.name(), level, 0, 0, static_cast<GLsizei>(map.width),
                                static_cast<GLsizei>(map.height), components, type, texels);
        };
        if (floats) {
            upload(GL_FLOAT, interleaved<float>(map, channels, [](float value) { return value; }).data());
        } else {
            const auto byte = [](float value) { return stored_derivative(value, 1); };
            const std::vector<std::int8_t> bytes = interleaved<std::int8_t>(map, channels, byte);
            if (format != GL_COMPRESSED_SIGNED_RG_RGTC2) {
                upload(GL_BYTE, bytes.data());
                continue;
            }
            const std::vector<std::uint8_t> blocks = rgtc2_signed(bytes, map.width, map.height);
            glCompressedTextureSubImage2D(texture.name(), level, 0, 0, static_cast<GLsizei>(map.width),
                                          static_cast<GLsizei>(map.height), format, static_cast<GLsizei>(blocks.size()),
                                          blocks.data());
        }
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    return texture;
}

NormalMap normals_of(const Image& image) {
    NormalMap normals(image.width, image.height, glm::vec3(0, 0, 1));
    if (image.channels < 3) return normals;
    for (std::size_t i = 0; i < normals.values.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t k = i * image.channels + c;
            const float stored = image.bytes.empty() ? image.floats[k] : static_cast<float>(image.bytes[k]) / 255;
            normals.values[i][static_cast<glm::length_t>(c)] = 2 * stored - 1;
        }
    }
    return normals;
}

float base_normal_range(const NormalMap& normals) {
    constexpr float widest = 4;
    std::vector<float> steepest;
    steepest.reserve(normals.values.size());
    for (const glm::vec3& normal : normals.values) {
        const glm::vec2 derivative = derivative_from_normal(normal, widest);
        steepest.push_back(std::max(std::abs(derivative.x), std::abs(derivative.y)));
    }
    if (steepest.empty()) return published_derivative_range;
    const auto place = steepest.begin() + static_cast<std::ptrdiff_t>((steepest.size() - 1) * 999 / 1000);
    std::ranges::nth_element(steepest, place);
    return std::max(*place, published_derivative_range);
}

BaseNormalTexture make_base_normal_texture(const Image& image, GLenum format) {
    const NormalMap normals = normals_of(image);
    BaseNormalTexture made;
    made.range = base_normal_range(normals);
    Map<glm::vec3> derivatives(normals.width, normals.height);
    for (std::size_t i = 0; i < normals.values.size(); ++i)
        derivatives.values[i] = glm::vec3(derivative_from_normal(normals.values[i], made.range) / made.range, 0);
    if (format == 0) format = image.bytes.empty() ? GL_RG16F : GL_COMPRESSED_SIGNED_RG_RGTC2;
    made.texture = make_signed_texture(format, std::move(derivatives), 2);
    return made;
}

BaseNormalError base_normal_error(const Image& image, GLenum format) {
    const BaseNormalTexture made = make_base_normal_texture(image, format);
    std::vector<glm::vec2> stored(std::size_t{image.width} * image.height);
    glGetTextureImage(made.texture.name(), 0, GL_RG, GL_FLOAT, static_cast<GLsizei>(stored.size() * sizeof(glm::vec2)),
                      stored.data());
    const NormalMap normals = normals_of(image);
    BaseNormalError error;
    for (std::size_t i = 0; i < stored.size(); ++i) {
        const glm::dvec3 n(normal_from_derivative(stored[i] * made.range)), exact(normals.values[i]);
        const double radians = std::atan2(glm::length(glm::cross(n, exact)), glm::dot(n, exact));
        error.mean += radians * 180 / std::numbers::pi / static_cast<double>(stored.size());
        error.worst = std::max(error.worst, radians * 180 / std::numbers::pi);
    }
    return error;
}

}  // namespace blush
