#pragma once
/// Transient textures of the frame graph, kept from frame to frame.

#include <vector>

#include "runtime/frame/frame_graph.h"
#include "runtime/gl/object.h"

namespace blush::gl {

GLenum internal_format(PixelFormat format);
bool has_depth(PixelFormat format);
bool is_half_float(PixelFormat format);

class TexturePool final : public TextureSource {
public:
    std::uint32_t acquire(const TextureShape& shape) override;
    void release(std::uint32_t handle, const TextureShape& shape) override;

private:
    struct Kept {
        TextureShape shape;
        Texture texture;
        bool in_use = false;
        int frames_unused = 0;
    };
    std::vector<Kept> kept_;
};

}  // namespace blush::gl
