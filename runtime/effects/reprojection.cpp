/// The frame before, moved along the velocities, is blended into this one (jimenez-2012, 10.4.4): the second half of
/// T2x and 4x. What is blended in is that frame as it was before its own blend, so that nothing stays longer than a
/// frame.

#include <array>

#include "runtime/antialias/last_frame.h"
#include "runtime/effects/effects.h"
#include "runtime/effects/shared_settings.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/on_screen.h"
#include "runtime/frame/own_setting.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> rejection_choices = {"surface", "none"};

constexpr std::array<Setting, 2> settings = {{
    {.name = "falloff",
     .meaning =
         "K of equation 10.6: how fast the last frame's share falls where speeds differ, for speeds in pictures a "
         "frame; 0 blends everywhere and leaves ghosts",
     .lowest = 0,
     .highest = 1000,
     .default_number = 30},  // jimenez-2012, 10.4.4: "a value of 30 for all our examples"
    {"rejection",
     "surface: nothing is taken from where the last frame saw a surface that this one does not see there, moving "
     "alike; "
     "none: equation 10.6 alone, which leaves ghosts of what starts to move, or moves by less than a pixel",
     rejection_choices, 0},
}};
using Own = OwnSetting<reprojection_effect, settings>;

struct Reprojection {
    gl::Program program;
};

Need need(const FrameState& frame) {
    const auto off = [](std::string_view reason) {
        return Need{.on = false, .reason = reason, .can_be_forced = false};
    };
    const auto mode = static_cast<AntialiasingMode>(frame.settings.choice(antialiasing_mode));
    const bool asked = mode == AntialiasingMode::smaa_t2x || mode == AntialiasingMode::smaa_4x;
    if (!asked) return off("antialiasing.mode takes nothing from the last frame");
    if (!frame.facts.on_screen) return off(nothing_to_draw(frame.facts));
    if (!frame.sampling.temporal) {
        return off("there are no velocities (velocities.source=none): every frame stands alone");
    }
    if (!frame.facts.has_last_frame)
        return off("there is no last frame of this size and mode: it is the first, or a cut");
    return {.on = true, .reason = "antialiasing.mode takes half of its samples from the last frame"};
}

void reproject(FrameState& frame, const FrameGraph& graph, ResourceId from, ResourceId to) {
    const LastFrame& last = frame.own<LastFrame>();
    const KeptImage& before = last.images[1 - last.phase];
    const bool moves = frame.on(velocities_effect);
    // Forced velocities of what stands still are zero, and nothing is uncovered.
    const bool rejects = moves && frame.facts.moves && frame.settings.choice(Own("rejection")) == 0;
    bind_output(frame, graph, to);
    glUseProgram(frame.own<Reprojection>().program.name());
    glBindTextureUnit(0, graph[from].handle);
    glBindTextureUnit(1, before.color.name());
    // Never a name of 0, which would clear the unit's other targets, and they are the host's.
    if (moves) {
        glBindTextureUnit(2, graph[frame.resources.velocities].handle);
        glBindTextureUnit(3, graph[frame.resources.speeds].handle);
    }
    if (before.has_speeds) {
        glBindTextureUnit(4, before.speeds.name());
        glBindSampler(4, 0);
    }
    if (rejects) glBindTextureUnit(5, before.depth.name());
    glUniform1f(0, static_cast<float>(frame.settings.number(Own("falloff"))));
    glUniform1i(1, frame.view->output == Output::display_srgb ? 1 : 0);
    glUniform1i(2, moves ? 1 : 0);
    glUniform1i(3, before.has_speeds ? 1 : 0);
    glUniform1i(4, rejects ? 1 : 0);
    draw_screen(frame);
}

void declare(FrameState& frame) {
    gl::require_program(frame.own<Reprojection>().program, {"screen.vert", "antialias/reproject.frag"});
    const DisplayImages images = next_display(frame);
    const auto pass = [&frame, from = images.from, to = images.to](const FrameGraph& graph) {
        reproject(frame, graph, from, to);
    };
    frame.graph.pass("reproject", pass).reads(images.from).writes(images.to);
    if (frame.on(velocities_effect)) frame.graph.reads(frame.resources.velocities).reads(frame.resources.speeds);
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"a face that is not there", "the background, frame after frame",
     [](Face& face) {
         for (Primitive& primitive : face.primitives) primitive.index_count = 0;
     }},
}};

}  // namespace

const Effect reprojection_effect = {
    .name = "reprojection",
    .what = "the last frame's samples are moved along and blended in",
    .settings = settings,
    .owner = SettingOwner::view,
    .stage = Stage::history,
    .need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
