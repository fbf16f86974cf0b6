/// Several pictures of one frame, each drawn whole from its own place in the pixel, and their mean.
///
/// Not one picture of many times the size: each picture is what the frame would be with one sample a pixel, so that
/// what works in pixels (scattering, morphological filters) does there what it does in the modes that are compared with
/// it; memory does not grow with the number of pictures; and no device is too small for it.

#include <array>

#include "runtime/antialias/last_frame.h"
#include "runtime/antialias/pictures.h"
#include "runtime/effects/effects.h"
#include "runtime/effects/shared_settings.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/on_screen.h"
#include "runtime/frame/own_setting.h"

namespace blush {
namespace {

// 16: 256 pictures, an error of coverage of 1/512 at most along an axis-parallel edge, half a step of 8 bits.
constexpr std::array<Setting, 1> settings = {{
    {.name = "factor",
     .meaning = "pictures along each side of the pixel, in antialiasing.mode=supersampled: 8 draws 64",
     .lowest = 1,
     .highest = 16,
     .default_number = 4},
}};
using Own = OwnSetting<supersampling_effect, settings>;

struct Supersampling {
    gl::Program program;
};

Need need(const FrameState& frame) {
    if (frame.sampling.pictures == 1) {
        return {.on = false,
                .reason = frame.facts.on_screen ? "one picture a frame is asked for" : nothing_to_draw(frame.facts),
                .can_be_forced = false};
    }
    return {.on = true, .reason = "several pictures a frame are asked for"};
}

void average(FrameState& frame, GLuint mean_so_far, GLuint picture, glm::bvec2 encoded) {
    glUseProgram(frame.own<Supersampling>().program.name());
    glBindTextureUnit(0, mean_so_far);
    glBindTextureUnit(1, picture);
    glUniform1f(0, 1.0F / static_cast<float>(frame.picture + 1));
    glUniform2i(1, encoded.x ? 1 : 0, encoded.y ? 1 : 0);
    draw_screen(frame);
}

void declare(FrameState& frame) {
    gl::require_program(frame.own<Supersampling>().program, {"screen.vert", "antialias/average.frag"});
    const DisplayImages images = next_display(frame);
    const auto mean = [&frame, from = images.from, to = images.to](const FrameGraph& graph) {
        const bool encoded = frame.view->output == Output::display_srgb;
        const bool last = frame.picture + 1 == frame.sampling.pictures;
        bind_output(frame, graph, to);
        average(frame, pictures_so_far(frame), graph[from].handle, {encoded, encoded && last});
    };
    frame.graph.pass("average pictures", mean).reads(images.from).writes(images.to);
    if (!frame.on(velocities_effect)) return;

    // Speeds are filtered like colours (jimenez-2012, 10.4.4), so they are averaged like them.
    const ResourceId from = frame.resources.speeds, to = import_kept_speeds(frame);
    const auto mean_speed = [&frame, from, to](const FrameGraph& graph) {
        bind_output(frame, graph, to);
        average(frame, frame.own<Pictures>().first_speeds.name(), graph[from].handle, glm::bvec2(false));
    };
    frame.graph.pass("average speeds", mean_speed).reads(from).writes(to);
    frame.resources.speeds = to;
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"a face that is not there", "every picture is the background, and so is their mean",
     [](Face& face) {
         for (Primitive& primitive : face.primitives) primitive.index_count = 0;
     }},
}};

}  // namespace

constinit const SettingId supersampling_factor = Own("factor");

const Effect supersampling_effect = {
    .name = "supersampling",
    .what = "several pictures a frame are averaged",
    .settings = settings,
    .owner = SettingOwner::view,
    .stage = Stage::average,
    .need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
