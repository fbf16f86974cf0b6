#pragma once
/// Scans what a pass wrote for NaN, infinities and values beyond their format (promise 2: no silent wrong picture).

#include <optional>
#include <vector>

#include "runtime/frame/frame_graph.h"
#include "runtime/frame_report.h"
#include "runtime/gl/object.h"

namespace blush {

class FiniteCheck {
public:
    /// The first offender among the outputs of `pass`, or nothing. Reads the GPU back: for checking, not for playing.
    std::optional<NotFinite> scan(const FrameGraph& graph, const FramePass& pass);

private:
    std::optional<NotFinite> scan_buffer(const FrameResource& resource);
    std::optional<NotFinite> scan_texture(const FrameResource& resource);
    gl::Framebuffer read_framebuffer_, resolve_framebuffer_;
    gl::Texture resolved_;
    TextureShape resolved_shape_;
    std::vector<float> values_;
};

}  // namespace blush
