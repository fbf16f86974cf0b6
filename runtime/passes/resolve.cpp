/// Averages the samples of the multisampled images that shading wrote.

#include "runtime/frame.h"

namespace blush {

void declare_resolve(CharacterState& state) {
    const auto resolve = [&state](const FrameGraph& graph) {
        const auto width = static_cast<GLint>(state.view->width), height = static_cast<GLint>(state.view->height);
        const GLuint from = state.output_framebuffer.name(), to = state.resolved_framebuffer.name();
        for (std::size_t i = 0; i < state.resources.resolve_count; ++i) {
            const FrameResources::Resolved& image = state.resources.to_resolve[i];
            glNamedFramebufferTexture(from, GL_COLOR_ATTACHMENT0, graph[image.from].handle, 0);
            glNamedFramebufferTexture(to, GL_COLOR_ATTACHMENT0, graph[image.to].handle, 0);
            glBlitNamedFramebuffer(from, to, 0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        }
    };
    state.graph.pass("resolve", resolve);
    for (std::size_t i = 0; i < state.resources.resolve_count; ++i) {
        state.graph.reads(state.resources.to_resolve[i].from).writes(state.resources.to_resolve[i].to);
    }
}

}  // namespace blush
