/// Multisampling: several samples of coverage and depth a pixel, shaded once, and their resolve.

#include <array>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/on_screen.h"
#include "runtime/frame/own_setting.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 3> resolve_choices = {"auto", "average", "hdr"};
enum class Resolve : std::uint8_t { of_the_view, average, hdr };

constexpr std::array<Setting, 1> settings = {{
    {"resolve",
     "average: the mean radiance of a pixel's samples; hdr: bright samples weigh less, so that edges of highlights are "
     "smooth once shown; auto: hdr for a display, average of a view that asks for radiance",
     resolve_choices, static_cast<std::uint8_t>(Resolve::of_the_view)},
}};
using Own = OwnSetting<multisampling_effect, settings>;

struct Multisampling {
    gl::Program program;
};

Resolve resolve_of(const FrameState& frame) {
    const auto wanted = static_cast<Resolve>(frame.settings.choice(Own("resolve")));
    if (wanted != Resolve::of_the_view) return wanted;
    return frame.view->output == Output::display_srgb ? Resolve::hdr : Resolve::average;
}

Need need(const FrameState& frame) {
    if (frame.sampling.samples == 1) {
        return {.on = false,
                .reason = frame.facts.on_screen ? "one sample a pixel is asked for" : nothing_to_draw(frame.facts),
                .can_be_forced = false};
    }
    return {.on = true, .reason = "several samples a pixel are asked for"};
}

void blit(FrameState& frame, const FrameGraph& graph, ResourceId from, ResourceId to) {
    const auto width = static_cast<GLint>(frame.view->width), height = static_cast<GLint>(frame.view->height);
    glNamedFramebufferTexture(frame.common->output.name(), GL_COLOR_ATTACHMENT0, graph[from].handle, 0);
    glNamedFramebufferTexture(frame.common->resolved.name(), GL_COLOR_ATTACHMENT0, graph[to].handle, 0);
    glBlitNamedFramebuffer(frame.common->output.name(), frame.common->resolved.name(), 0, 0, width, height, 0, 0, width,
                           height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void weigh(FrameState& frame, const FrameGraph& graph, ResourceId from, ResourceId to) {
    const Multisampling& own = frame.own<Multisampling>();
    bind_output(frame, graph, to);
    glUseProgram(own.program.name());
    glBindTextureUnit(0, graph[frame.resources.scene_color_multisampled].handle);
    glBindTextureUnit(1, graph[from].handle);
    glUniform1f(0, frame.view->exposure);
    draw_screen(frame);
}

void declare_one(FrameState& frame, ResourceId from, ResourceId to) {
    const auto resolve = [&frame, from, to](const FrameGraph& graph) {
        if (resolve_of(frame) == Resolve::average) {
            blit(frame, graph, from, to);
        } else {
            weigh(frame, graph, from, to);
        }
    };
    frame.graph.pass("resolve", resolve).reads(frame.resources.scene_color_multisampled).reads(from).writes(to);
}

void declare(FrameState& frame) {
    Multisampling& own = frame.own<Multisampling>();
    if (resolve_of(frame) == Resolve::hdr) gl::require_program(own.program, {"screen.vert", "antialias/resolve.frag"});
    const FrameResources& resources = frame.resources;
    for (std::size_t i = 0; i < resources.resolve_count; ++i) {
        declare_one(frame, resources.to_resolve[i].from, resources.to_resolve[i].to);
    }
}

constexpr std::array<HardCase, 2> hard_cases = {{
    {"light beyond half precision behind the face", "the resolve stays finite", [](Face&) {}, 1,
     [](ViewFrame& view) {
         view.background_linear = {60000, 60000, 60000, 1};
     }},
    {"negative radiance behind the face", "weights stay between 0 and 1", [](Face&) {}, 1,
     [](ViewFrame& view) {
         view.background_linear = {-5, 0, 0, 1};
     }},
}};

}  // namespace

const Effect multisampling_effect = {
    .name = "multisampling",
    .what = "several samples of coverage a pixel",
    .settings = settings,
    .owner = SettingOwner::view,
    .stage = Stage::resolve,
    .need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
