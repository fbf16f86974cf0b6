/// The end of a picture: radiance to display values (filmic curve, sRGB), or as it is.

#include <cmath>

#include "runtime/frame/frame.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {

void declare_tone(FrameState& frame, ResourceId to) {
    const auto tone = [&frame, from = frame.resources.scene_color, to](const FrameGraph& graph) {
        bind_output(frame, graph, to);
        glUseProgram(frame.common->tone.name());
        glBindTextureUnit(BLUSH_SCENE_COLOR_UNIT, graph[from].handle);
        glBindSampler(BLUSH_SCENE_COLOR_UNIT, 0);
        const bool metered = frame.resources.log2_exposure.has_value();
        if (metered) glBindTextureUnit(1, graph[*frame.resources.log2_exposure].handle);
        // With metering they are in what was metered.
        const double stops = metered ? 0 : frame.exposure_stops;
        glUniform1f(0, frame.view->exposure * static_cast<float>(std::exp2(stops)));
        glUniform1i(1, metered ? 1 : 0);
        draw_screen(frame);
    };
    frame.graph.pass("tone", tone).reads(frame.resources.scene_color).writes(to);
    if (frame.resources.log2_exposure) frame.graph.reads(*frame.resources.log2_exposure);
}

void declare_copy(FrameState& frame, ResourceId from, ResourceId to) {
    const auto copy = [&frame, from, to](const FrameGraph& graph) {
        const auto width = static_cast<GLint>(frame.view->width), height = static_cast<GLint>(frame.view->height);
        const GLuint source = frame.common->resolved.name();
        glNamedFramebufferTexture(source, GL_COLOR_ATTACHMENT0, graph[from].handle, 0);
        bind_output(frame, graph, to);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, source);
        glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    };
    frame.graph.pass("copy", copy).reads(from).writes(to);
}

}  // namespace blush
