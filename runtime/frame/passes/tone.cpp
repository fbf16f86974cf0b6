/// The end of a picture: radiance to display values (filmic curve, sRGB), or as it is.

#include <cmath>

#include "runtime/frame/frame.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {

void declare_tone(CharacterState& state, ResourceId to) {
    const auto tone = [&state, from = state.resources.scene_color, to](const FrameGraph& graph) {
        bind_output(state, graph, to);
        glUseProgram(state.tone_program.name());
        glBindTextureUnit(BLUSH_SCENE_COLOR_UNIT, graph[from].handle);
        glBindSampler(BLUSH_SCENE_COLOR_UNIT, 0);
        const bool metered = state.on(exposure_effect);
        if (metered) glBindTextureUnit(1, graph[state.resources.log2_exposure].handle);
        // Without metering, the stops that the exposure is set to; with it they are in what was metered.
        const double stops = metered ? 0 : state.settings.number(exposure_effect.name, "stops");
        glUniform1f(0, state.view->exposure * static_cast<float>(std::exp2(stops)));
        glUniform1i(1, metered ? 1 : 0);
        draw_screen(state);
    };
    state.graph.pass("tone", tone).reads(state.resources.scene_color).writes(to);
    if (state.on(exposure_effect)) state.graph.reads(state.resources.log2_exposure);
}

void declare_copy(CharacterState& state, ResourceId from, ResourceId to) {
    const auto copy = [&state, from, to](const FrameGraph& graph) {
        const auto width = static_cast<GLint>(state.view->width), height = static_cast<GLint>(state.view->height);
        const GLuint source = state.resolved_framebuffer.name();
        glNamedFramebufferTexture(source, GL_COLOR_ATTACHMENT0, graph[from].handle, 0);
        bind_output(state, graph, to);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, source);
        glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    };
    state.graph.pass("copy", copy).reads(from).writes(to);
}

}  // namespace blush
