/// Bloom: bright light spreads a little over the whole picture, as in a lens and in an eye (jimenez-2012, 8.3, has it
/// among the effects of the camera).

#include "rig/camera/bloom.h"

#include <array>

#include "runtime/effects/effects.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/own_setting.h"

namespace blush {
namespace {

constexpr std::array<Setting, 3> settings = {{
    {.name = "strength", .meaning = "share of the bright light that spreads; 0: off", .highest = 1},
    {.name = "threshold", .meaning = "radiance above which light is bright; 0: all is", .highest = 1000},
    {.name = "radius",
     .meaning = "how far it spreads, of the picture's height",
     .lowest = 0.002,
     .highest = 0.5,
     .default_number = 0.06},
}};
using Own = OwnSetting<bloom_effect, settings>;

constexpr std::size_t most_levels = 8;

struct Bloom {
    gl::Program first, down, up, add;
    std::uint32_t levels = 0;
    std::array<ResourceId, most_levels + 1> halves{};  // [0]: the scene, [k]: a 2^k-th of its sides
    std::array<ResourceId, most_levels + 1> spread{};  // [k]: mean of the levels from k on
    ResourceId result{};
};

double number(const FrameState& frame, Own setting) { return frame.settings.number(setting); }

Need need(const FrameState& frame) {
    if (number(frame, "strength") == 0) {
        return {.on = false, .reason = "bloom.strength is 0", .can_be_forced = false};
    }
    return {.on = true, .reason = "bloom.strength asks for it"};
}

void bind(FrameState& frame, const FrameGraph& graph, const gl::Program& program, ResourceId from, ResourceId to) {
    bind_output(frame, graph, to);
    glUseProgram(program.name());
    glBindTextureUnit(0, graph[from].handle);
    glBindSampler(0, 0);
    glBindSampler(1, 0);
}

void halve(FrameState& frame, const FrameGraph& graph, std::size_t level) {
    Bloom& own = frame.own<Bloom>();
    bind(frame, graph, level == 1 ? own.first : own.down, own.halves[level - 1], own.halves[level]);
    if (level == 1) glUniform1f(0, static_cast<float>(number(frame, "threshold")));
    draw_screen(frame);
}

void enlarge(FrameState& frame, const FrameGraph& graph, std::size_t level) {
    Bloom& own = frame.own<Bloom>();
    bind(frame, graph, own.up, own.halves[level], own.spread[level]);
    glBindTextureUnit(1, graph[own.spread[level + 1]].handle);
    glUniform1f(0, 1.0F / static_cast<float>(own.levels - level + 1));
    draw_screen(frame);
}

void add(FrameState& frame, const FrameGraph& graph) {
    Bloom& own = frame.own<Bloom>();
    bind(frame, graph, own.add, own.halves[0], own.result);
    glBindTextureUnit(1, graph[own.spread[1]].handle);
    glUniform1f(0, static_cast<float>(number(frame, "strength")));
    glUniform1f(1, static_cast<float>(number(frame, "threshold")));
    draw_screen(frame);
}

void declare(FrameState& frame) {
    Bloom& own = frame.own<Bloom>();
    static constexpr std::array<std::string_view, 1> first_defines = {"FIRST"};
    gl::require_program(own.first, {"screen.vert", "camera/bloom_down.frag", first_defines});
    gl::require_program(own.down, {"screen.vert", "camera/bloom_down.frag"});
    gl::require_program(own.up, {"screen.vert", "camera/bloom_up.frag"});
    gl::require_program(own.add, {"screen.vert", "camera/bloom_add.frag"});

    const TextureShape full{PixelFormat::rgba16f, frame.view->width, frame.view->height, 1};
    TextureShape shape = full;
    own.levels = bloom_levels(number(frame, "radius"), full.width, full.height);
    own.halves[0] = frame.resources.scene_color;
    std::array<TextureShape, most_levels + 1> shapes{};
    for (std::size_t k = 1; k <= own.levels; ++k) {
        shape.width = (shape.width + 1) / 2;
        shape.height = (shape.height + 1) / 2;
        shapes[k] = shape;
        own.halves[k] = frame.graph.texture("bloom, halved", shape);
        frame.graph.pass("bloom: halve", [&frame, k](const FrameGraph& graph) { halve(frame, graph, k); })
            .reads(own.halves[k - 1])
            .writes(own.halves[k]);
    }
    own.spread[own.levels] = own.halves[own.levels];
    for (std::size_t k = own.levels - 1; k > 0; --k) {
        own.spread[k] = frame.graph.texture("bloom, spread", shapes[k]);
        frame.graph.pass("bloom: enlarge", [&frame, k](const FrameGraph& graph) { enlarge(frame, graph, k); })
            .reads(own.halves[k])
            .reads(own.spread[k + 1])
            .writes(own.spread[k]);
    }
    own.result = frame.graph.texture("scene colour, with bloom", full);
    frame.graph.pass("bloom: add", [&frame](const FrameGraph& graph) { add(frame, graph); })
        .reads(own.halves[0])
        .reads(own.spread[1])
        .writes(own.result);
    frame.resources.scene_color = own.result;
}

constexpr std::array<HardCase, 3> hard_cases = {{
    {"a frame of one pixel", "nothing to spread over", [](Face&) {}, 0,
     [](ViewFrame& view) { view.width = view.height = 1; }},
    {"a black frame", "black everywhere",
     [](Face& face) {
         for (Primitive& primitive : face.primitives) primitive.index_count = 0;
     },
     0, [](ViewFrame& view) { view.background_linear = glm::vec4(0); }},
    {"a background as bright as radiance may be", "no sum overflows", [](Face&) {}, 0,
     [](ViewFrame& view) { view.background_linear = glm::vec4(60000); }},
}};

}  // namespace

const Effect bloom_effect = {
    .name = "bloom",
    .what = "bright light spreads over the picture",
    .settings = settings,
    .owner = SettingOwner::view,
    .stage = Stage::scene,
    .need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
