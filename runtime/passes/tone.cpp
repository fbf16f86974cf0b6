/// The end of a frame: radiance to display values (filmic curve, sRGB), or as it is.

#include "runtime/frame.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {

void declare_tone(CharacterState& state) {
    const auto tone = [&state](const FrameGraph& graph) {
        bind_output(state, graph, state.resources.display);
        glUseProgram(state.tone_program.name());
        glBindTextureUnit(BLUSH_SCENE_COLOR_UNIT, graph[state.resources.scene_color].handle);
        glBindSampler(BLUSH_SCENE_COLOR_UNIT, 0);
        glUniform1f(0, state.view->exposure);
        glBindVertexArray(state.no_attributes.name());
        glDrawArrays(GL_TRIANGLES, 0, 3);
    };
    state.graph.pass("tone", tone).reads(state.resources.scene_color).writes(state.resources.display);
}

void declare_copy(CharacterState& state) {
    const auto copy = [&state](const FrameGraph& graph) {
        const auto width = static_cast<GLint>(state.view->width), height = static_cast<GLint>(state.view->height);
        glNamedFramebufferTexture(state.resolved_framebuffer.name(), GL_COLOR_ATTACHMENT0,
                                  graph[state.resources.scene_color].handle, 0);
        glBlitNamedFramebuffer(state.resolved_framebuffer.name(), state.view->framebuffer, 0, 0, width, height, 0, 0,
                               width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    };
    state.graph.pass("copy", copy).reads(state.resources.scene_color).writes(state.resources.target);
}

}  // namespace blush
