/// Grain of film, on the finished picture.

#include <array>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/own_setting.h"

namespace blush {
namespace {

constexpr std::array<Setting, 3> settings = {{
    {.name = "strength",
     .meaning = "standard deviation at middle grey, of display values from 0 to 1; 0: off",
     .highest = 0.3},
    {.name = "size", .meaning = "of a grain, pixels", .lowest = 1, .highest = 16, .default_number = 1},
    {.name = "seed", .meaning = "of the pattern; a whole number", .highest = 65535},
}};
using Own = OwnSetting<film_grain_effect, settings>;

struct FilmGrain {
    gl::Program program;
};

double number(const FrameState& frame, Own setting) { return frame.settings.number(setting); }

Need need(const FrameState& frame) {
    const auto off = [](std::string_view reason) {
        return Need{.on = false, .reason = reason, .can_be_forced = false};
    };
    if (number(frame, "strength") == 0) return off("grain.strength is 0");
    if (frame.view->output == Output::linear_hdr) return off("the view asks for radiance, and film is a display");
    return {.on = true, .reason = "grain.strength asks for it"};
}

void declare(FrameState& frame) {
    gl::require_program(frame.own<FilmGrain>().program, {"screen.vert", "camera/film_grain.frag"});
    const DisplayImages images = next_display(frame);
    const auto pass = [&frame, from = images.from, to = images.to](const FrameGraph& graph) {
        bind_output(frame, graph, to);
        glUseProgram(frame.own<FilmGrain>().program.name());
        glBindTextureUnit(0, graph[from].handle);
        glBindSampler(0, 0);
        glUniform1f(0, static_cast<float>(number(frame, "strength")));
        glUniform1f(1, static_cast<float>(number(frame, "size")));
        constexpr std::uint32_t seed_step = 0x9e3779b9U;  // 2^32 over the golden ratio: seeds' frames do not meet
        glUniform1ui(2, frame.view->frame_number + seed_step * static_cast<std::uint32_t>(number(frame, "seed")));
        draw_screen(frame);
    };
    frame.graph.pass("film grain", pass).reads(images.from).writes(images.to);
}

constexpr std::array<HardCase, 1> hard_cases = {{
    {"a frame of one pixel", "one grain is drawn", [](Face&) {}, 0,
     [](ViewFrame& view) { view.width = view.height = 1; }},
}};

}  // namespace

const Effect film_grain_effect = {
    .name = "grain",
    .what = "grain of film over the finished picture",
    .settings = settings,
    .owner = SettingOwner::view,
    .stage = Stage::display,
    .need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
