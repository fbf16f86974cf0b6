/// Averages the samples of the multisampled scene colour.

#include "runtime/frame.h"

namespace blush {

void declare_resolve(CharacterState& state) {
    const auto resolve = [&state](const FrameGraph& graph) {
        const auto width = static_cast<GLint>(state.view->width), height = static_cast<GLint>(state.view->height);
        glNamedFramebufferTexture(state.resolved_framebuffer.name(), GL_COLOR_ATTACHMENT0,
                                  graph[state.resources.scene_color].handle, 0);
        glBlitNamedFramebuffer(state.scene_framebuffer.name(), state.resolved_framebuffer.name(), 0, 0, width, height,
                               0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    };
    state.graph.pass("resolve", resolve)
        .reads(state.resources.scene_color_multisampled)
        .writes(state.resources.scene_color);
}

}  // namespace blush
