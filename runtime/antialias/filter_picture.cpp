#include "runtime/antialias/filter_picture.h"

#include <algorithm>
#include <string>

#include "rig/antialias/blend.h"
#include "rig/antialias/edges.h"
#include "rig/antialias/weights.h"
#include "runtime/antialias/antialias_passes.h"
#include "runtime/gl/state_guard.h"

namespace blush {
namespace {

/// A texture with a framebuffer around it.
struct Target {
    Target(int columns, int rows, GLenum format)
        : width(columns), height(rows), texture(gl::make_texture(GL_TEXTURE_2D)), framebuffer(gl::make_framebuffer()) {
        glTextureStorage2D(texture.name(), 1, format, width, height);
        glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
    }
    PassTarget pass() const {
        return {framebuffer.name(), static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    }
    template <class T>
    void write(GLenum format, const Grid<T>& cells) const {
        glTextureSubImage2D(texture.name(), 0, 0, 0, width, height, format, GL_FLOAT, cells.cells.data());
    }
    template <class T>
    void read(GLenum format, GLenum type, Grid<T>& cells) const {
        glGetTextureImage(texture.name(), 0, format, type, static_cast<GLsizei>(cells.cells.size() * sizeof(T)),
                          cells.cells.data());
    }
    int width, height;
    gl::Texture texture;
    gl::Framebuffer framebuffer;
};

}  // namespace

FilteredPicture filter_on_cpu(const Pixels& picture, const DepthPixels& depth, const FilterRequest& request) {
    FilteredPicture filtered;
    filtered.edges = find_edges(picture, depth, request.edges(), request.meaning);
    filtered.weights = request.filter == SpatialFilter::mlaa ? mlaa_weights(filtered.edges, request.mlaa)
                                                             : smaa_weights(filtered.edges, request.smaa);
    filtered.picture = blend_neighbors(picture, filtered.weights, request.meaning);
    return filtered;
}

Result<FilteredPicture> filter_on_gpu(const Device& device, const Pixels& picture, const DepthPixels& depth,
                                      const FilterRequest& request) {
    const int largest = device.info().largest_texture_side_texels, width = picture.width, height = picture.height;
    if (width < 1 || height < 1 || width > largest || height > largest) {
        return Error{"a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                     " pixels cannot be filtered on the GPU: a side may be 1 to " + std::to_string(largest)};
    }
    device.make_current();
    const gl::StateGuard guard;
    Result<AntialiasPasses> passes = AntialiasPasses::create();
    if (!passes) return passes.error();

    const GLenum format = request.eight_bits ? GL_RGBA8 : GL_RGBA32F;
    const Target color(width, height, format), edges(width, height, GL_RG8), weights(width, height, GL_RGBA8);
    const Target out(width, height, format), depths(std::max(depth.width, 1), std::max(depth.height, 1), GL_R32F);
    color.write(GL_RGBA, picture);
    if (!depth.cells.empty()) depths.write(GL_RED, depth);

    EdgeTiles tiles;
    passes->edges(color.texture.name(), depths.texture.name(), request.edges(), request.meaning, tiles, edges.pass());
    if (request.filter == SpatialFilter::mlaa) {
        passes->mlaa_weights(edges.texture.name(), request.mlaa, tiles, weights.pass());
    } else {
        passes->smaa_weights(edges.texture.name(), request.smaa, SubsampleSlices(0), tiles, weights.pass());
    }
    passes->blend(color.texture.name(), weights.texture.name(), request.meaning, tiles, out.pass());

    FilteredPicture filtered;
    filtered.picture = Pixels(width, height);
    filtered.edges = EdgeMap(width, height);
    filtered.weights = WeightMap(width, height);
    out.read(GL_RGBA, GL_FLOAT, filtered.picture);
    edges.read(GL_RG, GL_UNSIGNED_BYTE, filtered.edges);
    for (glm::u8vec2& edge : filtered.edges.cells) edge /= std::uint8_t{255};
    weights.read(GL_RGBA, GL_UNSIGNED_BYTE, filtered.weights);
    return filtered;
}

}  // namespace blush
