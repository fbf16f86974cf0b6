/// Exposure of the camera: fixed, or by the log-average luminance of the frame (Reinhard et al. 2002, 3.1;
/// jimenez-2012, 8.3, has automatic exposure among the effects of the camera), which it follows as an eye does.

#include <array>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/own_setting.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> mode_choices = {"fixed", "automatic"};
constexpr std::array<std::string_view, 2> metering_choices = {"frame", "centre"};
constexpr std::array<Setting, 7> settings = {{
    {"mode",
     "fixed: the view's exposure; automatic: times what brings the average of the frame to the key (of a view for a "
     "display)",
     mode_choices, 0},
    {"metering", "frame: every pixel counts alike; centre: those around the middle count most", metering_choices, 0},
    {.name = "key",
     .meaning = "exposed radiance that the log-average is brought to; 0.18 is a grey card",
     .lowest = 0.01,
     .highest = 2,
     .default_number = 0.18},
    {.name = "stops", .meaning = "compensation: 1 is twice as bright; in both modes", .lowest = -10, .highest = 10},
    {.name = "range_stops",
     .meaning = "how far the automatic exposure goes from the view's own, either way",
     .highest = 16,
     .default_number = 6},
    {.name = "darker_half_life",
     .meaning = "seconds in which half of the way is done when the light rises",
     .lowest = 0.001,
     .highest = 100,
     .default_number = 0.15},
    {.name = "brighter_half_life",
     .meaning = "seconds in which half of the way is done when the light falls",
     .lowest = 0.001,
     .highest = 100,
     .default_number = 0.5},
}};
using Own = OwnSetting<exposure_effect, settings>;

struct Exposure {
    gl::Program cells_program, adapt_program;
    std::array<gl::Texture, 2> log2_exposure;  // of this frame and the one before, in turn
    std::size_t now = 0;
    bool known = false;
    double seen_seconds = 0, passed_seconds = -1;
    ResourceId cells{};
};

double number(const FrameState& frame, Own setting) { return frame.settings.number(setting); }

void find_facts(FrameState& frame) { frame.exposure_stops = number(frame, "stops"); }

Need need(const FrameState& frame) {
    const auto off = [](std::string_view reason) {
        return Need{.on = false, .reason = reason, .can_be_forced = false};
    };
    if (frame.settings.choice(Own("mode")) == 0) return off("exposure.mode is fixed");
    if (frame.view->output == Output::linear_hdr) return off("the view asks for radiance, which has no exposure");
    return {.on = true, .reason = "exposure.mode is automatic"};
}

void meter(FrameState& frame, const FrameGraph& graph, ResourceId from) {
    Exposure& own = frame.own<Exposure>();
    bind_output(frame, graph, own.cells);
    glUseProgram(own.cells_program.name());
    glBindTextureUnit(BLUSH_SCENE_COLOR_UNIT, graph[from].handle);
    glBindSampler(BLUSH_SCENE_COLOR_UNIT, 0);
    glUniform1i(0, frame.settings.choice(Own("metering")));
    draw_screen(frame);
}

void adapt(FrameState& frame, const FrameGraph& graph) {
    Exposure& own = frame.own<Exposure>();
    bind_output(frame, graph, *frame.resources.log2_exposure);
    glUseProgram(own.adapt_program.name());
    glBindTextureUnit(0, graph[own.cells].handle);
    glBindTextureUnit(1, own.log2_exposure[1 - own.now].name());
    glBindSampler(0, 0);
    glBindSampler(1, 0);
    const auto value = [&frame](Own setting) { return static_cast<float>(number(frame, setting)); };
    glUniform3f(0, value("key"), value("stops"), value("range_stops"));
    glUniform3f(1, static_cast<float>(own.passed_seconds), value("darker_half_life"), value("brighter_half_life"));
    draw_screen(frame);
}

void declare(FrameState& frame) {
    Exposure& own = frame.own<Exposure>();
    constexpr TextureShape one{PixelFormat::r32f, 1, 1, 1};
    if (frame.picture == 0) {  // all pictures of a frame are exposed alike
        const ViewFrame& view = *frame.view;
        for (gl::Texture& texture : own.log2_exposure) {
            if (texture) continue;
            texture = gl::make_texture(GL_TEXTURE_2D);
            glTextureStorage2D(texture.name(), 1, GL_R32F, 1, 1);
        }
        gl::require_program(own.cells_program, {"screen.vert", "camera/exposure_cells.frag"});
        gl::require_program(own.adapt_program, {"screen.vert", "camera/exposure_adapt.frag"});
        const double passed = view.time_seconds - own.seen_seconds;
        own.passed_seconds = own.known && !view.cut && passed > 0 ? passed : -1;
        own.known = true;
        own.seen_seconds = view.time_seconds;
        own.now = 1 - own.now;
    }
    frame.resources.log2_exposure = frame.graph.import_texture("exposure", own.log2_exposure[own.now].name(), one);
    if (frame.picture != 0) return;
    own.cells = frame.graph.texture("luminance of cells",
                                    {PixelFormat::rgba32f, BLUSH_EXPOSURE_CELLS, BLUSH_EXPOSURE_CELLS, 1});
    const auto metered = [&frame, from = frame.resources.scene_color](const FrameGraph& graph) {
        meter(frame, graph, from);
    };
    frame.graph.pass("meter", metered).reads(frame.resources.scene_color).writes(own.cells);
    frame.graph.pass("adapt exposure", [&frame](const FrameGraph& graph) { adapt(frame, graph); })
        .reads(own.cells)
        .writes(*frame.resources.log2_exposure);
}

constexpr std::array<HardCase, 3> hard_cases = {{
    {"a black frame", "as bright as exposure.range_stops lets it become",
     [](Face& face) {
         for (Primitive& primitive : face.primitives) primitive.index_count = 0;
     },
     0, [](ViewFrame& view) { view.background_linear = glm::vec4(0); }},
    {"a frame of one pixel", "metered like any other", [](Face&) {}, 0,
     [](ViewFrame& view) { view.width = view.height = 1; }},
    {"a background as bright as radiance may be", "as dark as exposure.range_stops lets it become", [](Face&) {}, 0,
     [](ViewFrame& view) { view.background_linear = glm::vec4(60000); }},
}};

}  // namespace

const Effect exposure_effect = {
    .name = "exposure",
    .what = "the camera follows the light",
    .settings = settings,
    .owner = SettingOwner::view,
    .stage = Stage::scene,
    .find_facts = find_facts,
    .need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
