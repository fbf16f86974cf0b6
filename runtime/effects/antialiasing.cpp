/// The morphological filters on each picture of a frame: MLAA (jimenez-2012, chapter 9) and SMAA (chapter 10).
///
/// The filter stands after the filmic curve: what is an edge to a viewer is one in display values. Of a view that asks
/// for radiance, edges are found in display values all the same, and radiance is blended with the weights found.

#include <array>
#include <cmath>
#include <optional>

#include "runtime/antialias/antialias_passes.h"
#include "runtime/antialias/last_frame.h"
#include "runtime/antialias/pictures.h"
#include "runtime/effects/effects.h"
#include "runtime/effects/shared_settings.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/on_screen.h"
#include "runtime/frame/own_setting.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 3> edge_choices = {"luma", "color", "depth"};
constexpr std::array<std::string_view, 2> predication_choices = {"off", "on"};
constexpr double of_preset = -1;

constexpr std::array<Setting, 12> settings = {{
    {"mode",
     "view: multisampling with ViewFrame::samples; none: one sample a pixel; msaa2, msaa4: multisampling; mlaa: the "
     "filter "
     "of "
     "2011; smaa_1x: SMAA's filter; smaa_s2x: on two pictures a frame; smaa_t2x: on pictures of two places in turn; "
     "smaa_4x: both; supersampled: the mean of supersampling.factor squared pictures",
     antialiasing_modes, static_cast<std::uint8_t>(AntialiasingMode::view)},
    {"preset", "low, medium, high, ultra: SMAA's thresholds and reaches", smaa_preset_names,
     static_cast<std::uint8_t>(SmaaPreset::high)},
    {"edges", "luma, color: of display values; depth: silhouettes alone", edge_choices,
     static_cast<std::uint8_t>(EdgeSource::luma)},
    {.name = "threshold",
     .meaning = "contrast of an edge, of 1; -1: the preset's",
     .lowest = of_preset,
     .highest = 0.5,
     .default_number = of_preset},
    {.name = "contrast_factor",
     .meaning = "an edge needs this share of the greatest contrast beside it; 0 of MLAA; -1: the preset's",
     .lowest = of_preset,
     .highest = 1,
     .default_number = of_preset},
    {.name = "search_steps",
     .meaning = "reach along a line, in steps of two pixels; -1: the preset's",
     .lowest = of_preset,
     .highest = largest_search_steps,
     .default_number = of_preset},
    {.name = "diagonal_search_steps",
     .meaning = "reach along a diagonal, pixels, 0 for no diagonals; -1: the preset's",
     .lowest = of_preset,
     .highest = largest_diagonal_search_steps,
     .default_number = of_preset},
    {.name = "corner_rounding",
     .meaning = "how much a sharp corner is rounded, of 1; -1: the preset's",
     .lowest = of_preset,
     .highest = 1,
     .default_number = of_preset},
    {.name = "depth_threshold",
     .meaning = "difference of window depth that is an edge, for edges=depth and predication",
     .lowest = 0,
     .highest = 1,
     .default_number = static_cast<double>(EdgeSettings{}.depth_threshold)},
    {"predication", "off: one threshold; on: a lower one on silhouettes and a higher one elsewhere",
     predication_choices, 0},
    {.name = "predication_scale",
     .meaning = "factor on the threshold under predication",
     .lowest = 1,
     .highest = 5,
     .default_number = static_cast<double>(Predication{}.scale)},
    {.name = "predication_strength",
     .meaning = "share by which a silhouette lowers the threshold",
     .lowest = 0,
     .highest = 1,
     .default_number = static_cast<double>(Predication{}.strength)},
}};
using Own = OwnSetting<antialiasing_effect, settings>;

struct Antialiasing {
    std::optional<AntialiasPasses> passes;
    EdgeTiles tiles;
    SmaaSettings smaa;
    MlaaSettings mlaa;
    SubsampleSlices slices{0};
    struct Blend {
        ResourceId image{}, weights{}, to{};
    };
    Blend colors, speeds;
};

/// Display values, or radiance.
PictureMeaning meaning_of(Output output) {
    return {.transfer = output == Output::display_srgb ? Transfer::srgb : Transfer::linear};
}

float number_or(const EffectSettings& all, Own name, float preset) {
    const double value = all.number(name);
    return value < 0 ? preset : static_cast<float>(value);
}
int steps_or(const EffectSettings& all, Own name, int least, int most, int preset) {
    const double value = all.number(name);
    return value < 0 ? preset : std::clamp(static_cast<int>(std::lround(value)), least, most);
}

EdgeSettings edge_settings(const EffectSettings& all, EdgeSettings preset) {
    preset.source = static_cast<EdgeSource>(all.choice(Own("edges")));
    preset.threshold = number_or(all, "threshold", preset.threshold);
    preset.contrast_factor = number_or(all, "contrast_factor", preset.contrast_factor);
    preset.depth_threshold = number_or(all, "depth_threshold", preset.depth_threshold);
    preset.predication.on = all.choice(Own("predication")) != 0;
    preset.predication.depth_threshold = preset.depth_threshold;
    preset.predication.scale = number_or(all, "predication_scale", preset.predication.scale);
    preset.predication.strength = number_or(all, "predication_strength", preset.predication.strength);
    return preset;
}

void find_settings(FrameState& frame, Antialiasing& own) {
    const EffectSettings& all = frame.settings;
    own.smaa = smaa_preset(static_cast<SmaaPreset>(all.choice(Own("preset"))));
    own.smaa.edges = edge_settings(all, own.smaa.edges);
    own.smaa.search_steps = steps_or(all, "search_steps", 1, largest_search_steps, own.smaa.search_steps);
    own.smaa.diagonal_search_steps =
        steps_or(all, "diagonal_search_steps", 0, largest_diagonal_search_steps, own.smaa.diagonal_search_steps);
    own.smaa.corner_rounding = number_or(all, "corner_rounding", own.smaa.corner_rounding);
    own.mlaa = {};
    own.mlaa.edges = edge_settings(all, own.mlaa.edges);
    own.mlaa.search_steps = steps_or(all, "search_steps", 1, largest_mlaa_search_steps, own.mlaa.search_steps);
    // Rows of a frame's textures count upwards, as the offsets do.
    const std::uint32_t phase = frame.own<LastFrame>().phase;
    own.slices = subsample_slices(frame.sampling.sample_offset_pixels(frame.picture, phase));
}

Need need(const FrameState& frame) {
    if (!frame.sampling.filtered) {
        return {.on = false,
                .reason = frame.facts.on_screen ? "antialiasing.mode asks for no filter" : nothing_to_draw(frame.facts),
                .can_be_forced = false};
    }
    return {.on = true, .reason = "antialiasing.mode asks for a filter"};
}

PassTarget target_of(FrameState& frame, const FrameGraph& graph, ResourceId image) {
    bind_output(frame, graph, image);
    const FrameResource& resource = graph[image];
    const bool texture = resource.kind == ResourceKind::texture;
    return {texture ? frame.common->output.name() : resource.handle, resource.shape.width, resource.shape.height};
}

/// Makes the passes where they are not there yet. False: they cannot be, which the frame reports.
bool require_passes(FrameState& frame) {
    std::optional<AntialiasPasses>& passes = frame.own<Antialiasing>().passes;
    if (passes) return true;
    Result<AntialiasPasses> made = AntialiasPasses::create();
    if (made) {
        passes = *std::move(made);
    } else {
        frame.shared.programs.fail(made.error());
    }
    return passes.has_value();
}

const AntialiasPasses& passes_of(FrameState& frame) { return *frame.own<Antialiasing>().passes; }

ResourceId declare_edges(FrameState& frame, ResourceId guide) {
    TextureShape shape{PixelFormat::rg8, frame.view->width, frame.view->height, 1};
    const ResourceId edges = frame.graph.texture("edges", shape);
    const auto find = [&frame, guide, edges](const FrameGraph& graph) {
        Antialiasing& own = frame.own<Antialiasing>();
        const bool mlaa = frame.sampling.mode == AntialiasingMode::mlaa;
        passes_of(frame).edges(graph[guide].handle, graph[frame.resources.scene_depth].handle,
                               mlaa ? own.mlaa.edges : own.smaa.edges, meaning_of(Output::display_srgb), own.tiles,
                               target_of(frame, graph, edges));
    };
    frame.graph.pass("find edges", find).reads(guide).reads(frame.resources.scene_depth).writes(edges);
    return edges;
}

ResourceId declare_weights(FrameState& frame, ResourceId edges) {
    TextureShape shape{PixelFormat::rgba8, frame.view->width, frame.view->height, 1};
    const ResourceId weights = frame.graph.texture("blending weights", shape);
    const auto weigh = [&frame, edges, weights](const FrameGraph& graph) {
        const Antialiasing& own = frame.own<Antialiasing>();
        const PassTarget target = target_of(frame, graph, weights);
        if (frame.sampling.mode == AntialiasingMode::mlaa) {
            passes_of(frame).mlaa_weights(graph[edges].handle, own.mlaa, own.tiles, target);
        } else {
            passes_of(frame).smaa_weights(graph[edges].handle, own.smaa, own.slices, own.tiles, target);
        }
    };
    frame.graph.pass("weigh edges", weigh).reads(edges).writes(weights);
    return weights;
}

void blend_pass(FrameState& frame, const FrameGraph& graph, const Antialiasing::Blend& blend,
                const PictureMeaning& meaning) {
    passes_of(frame).blend(graph[blend.image].handle, graph[blend.weights].handle, meaning,
                           frame.own<Antialiasing>().tiles, target_of(frame, graph, blend.to));
}

/// Speeds go through the filter as the colours do, so that a blended pixel moves as what it was blended from
/// (jimenez-2012, 10.4.4; there in the alpha channel, for nothing; here beside it, since alpha is the host's).
void declare_speeds(FrameState& frame, ResourceId weights) {
    const TextureShape shape{PixelFormat::r16f, frame.view->width, frame.view->height, 1};
    const bool first_of_two = frame.picture + 1 < frame.sampling.pictures;
    const ResourceId from = frame.resources.velocities;
    const ResourceId to = first_of_two                   ? first_speeds_store(frame, shape, frame.graph)
                          : frame.sampling.pictures == 1 ? import_kept_speeds(frame)
                                                         : frame.graph.texture("speeds", shape);
    frame.own<Antialiasing>().speeds = {from, weights, to};
    const auto blend = [&frame](const FrameGraph& graph) {
        blend_pass(frame, graph, frame.own<Antialiasing>().speeds, meaning_of(Output::linear_hdr));
    };
    frame.graph.pass("blend speeds", blend).reads(from).reads(weights).writes(to);
    frame.resources.speeds = to;
    if (first_of_two) frame.graph.present(to);
}

void declare(FrameState& frame) {
    if (!require_passes(frame)) return;
    Antialiasing& own = frame.own<Antialiasing>();
    find_settings(frame, own);
    const DisplayImages images = next_display(frame);
    ResourceId guide = images.from;
    if (frame.view->output == Output::linear_hdr) {
        guide = frame.graph.texture("display values", {PixelFormat::rgba8, frame.view->width, frame.view->height, 1});
        declare_tone(frame, guide);
    }
    const ResourceId weights = declare_weights(frame, declare_edges(frame, guide));
    own.colors = {images.from, weights, images.to};
    const auto blend = [&frame](const FrameGraph& graph) {
        blend_pass(frame, graph, frame.own<Antialiasing>().colors, meaning_of(frame.view->output));
    };
    frame.graph.pass("blend neighbours", blend).reads(images.from).reads(weights).writes(images.to);
    if (frame.sampling.temporal && frame.on(velocities_effect)) declare_speeds(frame, weights);
}

/// Whatever the settings under test, through the filter with all that it has.
constexpr std::array<HardCase, 2> hard_cases = {{
    {"light beyond half precision behind the face", "edges and weights stay in range", [](Face&) {}, 1,
     [](ViewFrame& view) {
         view.background_linear = {60000, 60000, 60000, 1};
     }},
    {"a picture of one pixel", "no neighbour is read that is not there", [](Face&) {}, 1,
     [](ViewFrame& view) { view.width = view.height = 1; }},
}};

}  // namespace

constinit const SettingId antialiasing_mode = Own("mode");

const Effect antialiasing_effect = {
    .name = "antialiasing",
    .what = "edges of the picture are found and smoothed",
    .settings = settings,
    .owner = SettingOwner::view,
    .stage = Stage::filter,
    .need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
