/// Depth of field: what is out of focus is blurred by its circle of confusion, as a thin lens of real size makes it.

#include "rig/camera/depth_of_field.h"

#include <array>
#include <cmath>

#include "rig/head/material_kind.h"
#include "runtime/effects/effects.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/own_setting.h"
#include "runtime/gl/shared_blocks.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 3> sample_choices = {"25", "49", "81"};
constexpr std::array<std::uint32_t, 3> sample_counts = {25, 49, 81};
constexpr double sensor_height_mm = 24;  // of a 35 mm frame

constexpr std::array<Setting, 5> settings = {{
    {.name = "f_number",
     .meaning = "focal length over the lens's opening: 1.4 is wide open, 16 nearly all sharp; 0: all sharp",
     .highest = 1000},
    {.name = "focal_length_mm",
     .meaning = "of the lens, millimetres; 0: the one that gives the camera's field of view on a 35 mm frame",
     .highest = 10000},
    {.name = "focus_mm",
     .meaning = "distance that is sharp, millimetres from the camera along its axis; 0: the eyes",
     .highest = 1e9},
    {.name = "largest_radius",
     .meaning = "of a circle of confusion, of the picture's height",
     .highest = 0.1,
     .default_number = 0.03},
    {"samples", "pixels that each one gathers: 25 (coarse discs), 49 or 81", sample_choices, 1},
}};
using Own = OwnSetting<depth_of_field_effect, settings>;

struct DepthOfField {
    gl::Program circles, circles_multisampled, tiles, gather;
    BlurRadius blur;
    int tile_pixels = 1;
    std::uint8_t samples = 0;     // that `taps` are of
    std::vector<glm::vec2> taps;  // none yet: not made
    ResourceId from{}, radius{}, in_front{}, to{};
};

double number(const FrameState& frame, Own setting) { return frame.settings.number(setting); }

/// Distance along the camera's axis of a character's corneas; without eyes, of the face's middle.
double eyes_mm(const FrameState& frame, const CharacterState& character) {
    const auto depth = [&](const glm::dvec3& place_world) {
        const glm::dvec4 view = frame.view->camera.view_from_world * glm::dvec4(place_world, 1);
        return -view.z * character.millimetres_a_unit;
    };
    const std::vector<Eyeball>& eyes = character.facts_of_face.eye_sockets.eyes;
    if (eyes.empty()) return depth(character.centre_world);
    constexpr double cornea_before_centre_mm = 12;  // half of an adult's eyeball (Bekerman et al. 2014)
    double sum = 0;
    for (const Eyeball& eye : eyes) {
        sum += depth(glm::dvec3(character.stance.world_from_node[eye.node] * glm::dvec4(eye.centre, 1)));
    }
    return sum / static_cast<double>(eyes.size()) - cornea_before_centre_mm;
}

/// The character that the camera is focused on: the nearest one before it that may be seen; none: null.
const CharacterState* focused(const FrameState& frame) {
    const CharacterState* nearest = nullptr;
    double distance_mm = 0;
    for (const CharacterState* character : frame.characters) {
        const double mm = eyes_mm(frame, *character);
        const bool better = nearest == nullptr || (mm > 0 && (distance_mm <= 0 || mm < distance_mm));
        if (!better || (nearest != nullptr && !character->report->on_screen)) continue;
        nearest = character;
        distance_mm = mm;
    }
    return nearest;
}

double millimetres_a_unit(const FrameState& frame) {
    const CharacterState* character = focused(frame);
    return character != nullptr ? character->millimetres_a_unit : 1000;  // glTF's unit is a metre
}

BlurRadius find_blur(FrameState& frame) {
    const double scale = std::abs(static_cast<double>(frame.clip_from_view[1][1]));
    ThinLens lens;
    lens.f_number = number(frame, "f_number");
    // A field of view is a focal length for a sensor: tan(half of it) = half the sensor / focal length.
    lens.focal_length_mm = number(frame, "focal_length_mm");
    lens.sensor_height_mm = sensor_height_mm;
    if (lens.focal_length_mm > 0) {
        lens.sensor_height_mm = 2 * lens.focal_length_mm / scale;
    } else {
        lens.focal_length_mm = 0.5 * sensor_height_mm * scale;
    }
    lens.focus_mm = number(frame, "focus_mm");
    if (lens.focus_mm == 0) lens.focus_mm = focused(frame) != nullptr ? eyes_mm(frame, *focused(frame)) : 0;
    const double height = frame.view->height;
    return blur_radius(lens, height, number(frame, "largest_radius") * height);
}

Need need(const FrameState& frame) {
    const auto off = [](std::string_view reason) {
        return Need{.on = false, .reason = reason, .can_be_forced = false};
    };
    if (number(frame, "f_number") == 0) return off("depth_of_field.f_number is 0");
    const glm::mat4& clip = frame.clip_from_view;
    if (clip[2][3] == 0 || !(std::abs(clip[1][1]) > 0) || !std::isfinite(clip[1][1]) || clip[3][2] == 0) {
        return off("the camera is no perspective: it has no lens");
    }
    if (number(frame, "largest_radius") * frame.view->height < 0.5) {
        return off("depth_of_field.largest_radius is less than half a pixel");
    }
    return {.on = true, .reason = "depth_of_field.f_number asks for it"};
}

void bind_texture(const FrameGraph& graph, GLuint unit, ResourceId id) {
    glBindTextureUnit(unit, graph[id].handle);
    glBindSampler(unit, 0);
}

void find_circles(FrameState& frame, const FrameGraph& graph) {
    DepthOfField& own = frame.own<DepthOfField>();
    const bool multisampled = graph[frame.resources.scene_depth].shape.samples > 1;
    bind_output(frame, graph, own.radius);
    glUseProgram((multisampled ? own.circles_multisampled : own.circles).name());
    bind_texture(graph, 0, frame.resources.scene_depth);
    glUniform3f(0, static_cast<float>(own.blur.scale_pixels), static_cast<float>(own.blur.focus_mm),
                static_cast<float>(own.blur.largest_pixels));
    const glm::mat4& clip = frame.clip_from_view;
    glUniform3f(1, clip[2][2], clip[3][2], static_cast<float>(millimetres_a_unit(frame)));
    draw_screen(frame);
}

void find_tiles(FrameState& frame, const FrameGraph& graph) {
    DepthOfField& own = frame.own<DepthOfField>();
    bind_output(frame, graph, own.in_front);
    glUseProgram(own.tiles.name());
    bind_texture(graph, 0, own.radius);
    glUniform1i(0, own.tile_pixels);
    draw_screen(frame);
}

void gather(FrameState& frame, const FrameGraph& graph) {
    DepthOfField& own = frame.own<DepthOfField>();
    bind_output(frame, graph, own.to);
    glUseProgram(own.gather.name());
    bind_texture(graph, 0, own.from);
    bind_texture(graph, 1, own.radius);
    bind_texture(graph, 2, own.in_front);
    const std::uint8_t samples = frame.settings.choice(Own("samples"));
    if (own.taps.empty() || own.samples != samples) own.taps = blur_taps(sample_counts[samples]);
    own.samples = samples;
    const std::vector<glm::vec2>& taps = own.taps;
    glUniform1i(0, own.tile_pixels);
    glUniform1i(1, static_cast<GLint>(taps.size()));
    glUniform2fv(2, static_cast<GLsizei>(taps.size()), &taps[0].x);
    draw_screen(frame);
}

void declare(FrameState& frame) {
    DepthOfField& own = frame.own<DepthOfField>();
    static constexpr std::array<std::string_view, 1> multisampled = {"MULTISAMPLED"};
    gl::require_program(own.circles, {"screen.vert", "camera/circle_of_confusion.frag"});
    gl::require_program(own.circles_multisampled, {"screen.vert", "camera/circle_of_confusion.frag", multisampled});
    gl::require_program(own.tiles, {"screen.vert", "camera/blur_tiles.frag"});
    gl::require_program(own.gather, {"screen.vert", "camera/depth_of_field.frag"});
    own.blur = find_blur(frame);
    // A circle reaches the tiles beside its own at most.
    constexpr double least_tile = 8;
    own.tile_pixels = static_cast<int>(std::ceil(std::max(own.blur.largest_pixels, least_tile)));

    const auto tiles = [&own](std::uint32_t pixels) {
        const auto tile = static_cast<std::uint32_t>(own.tile_pixels);
        return (pixels + tile - 1) / tile;
    };
    TextureShape shape{PixelFormat::rgba16f, frame.view->width, frame.view->height, 1};
    own.from = frame.resources.scene_color;
    own.to = frame.graph.texture("scene colour, in focus", shape);
    shape.format = PixelFormat::r32f;
    own.radius = frame.graph.texture("circles of confusion", shape);
    own.in_front =
        frame.graph.texture("circles in front", {PixelFormat::r32f, tiles(shape.width), tiles(shape.height), 1});
    frame.graph.pass("circles of confusion", [&frame](const FrameGraph& graph) { find_circles(frame, graph); })
        .reads(frame.resources.scene_depth)
        .writes(own.radius);
    frame.graph.pass("circles in front", [&frame](const FrameGraph& graph) { find_tiles(frame, graph); })
        .reads(own.radius)
        .writes(own.in_front);
    frame.graph.pass("depth of field", [&frame](const FrameGraph& graph) { gather(frame, graph); })
        .reads(own.from)
        .reads(own.radius)
        .reads(own.in_front)
        .writes(own.to);
    frame.resources.scene_color = own.to;
}

constexpr std::array<HardCase, 4> hard_cases = {{
    {"a camera inside the face", "blurred as far as depth_of_field.largest_radius", [](Face&) {}, 0,
     [](ViewFrame& view) { view.camera.view_from_world = glm::dmat4(1); }},
    {"a face behind the camera", "the background", [](Face&) {}, 0,
     [](ViewFrame& view) { view.camera.view_from_world[3].z += 1e3; }},
    {"an orthographic camera", "left out: it has no lens", [](Face&) {}, 0,
     [](ViewFrame& view) {
         glm::mat4 clip(1);
         clip[2][2] = -0.01F;
         view.camera.clip_from_view = clip;
     }},
    {"a frame of one pixel", "nothing to gather from", [](Face&) {}, 0,
     [](ViewFrame& view) { view.width = view.height = 1; }},
}};

}  // namespace

const Effect depth_of_field_effect = {
    .name = "depth_of_field",
    .what = "what is out of focus is blurred",
    .settings = settings,
    .owner = SettingOwner::view,
    .stage = Stage::scene,
    .need = need,
    .declare = declare,
    .hard_cases = hard_cases,
};

}  // namespace blush
