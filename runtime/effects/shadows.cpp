/// Shadow maps of the lights: what shadows and light through thin parts are read from (chappuis-2011, 2.4).

#include <array>

#include "runtime/draw/draw_casters.h"
#include "runtime/draw/draw_face.h"
#include "runtime/draw/hair_core.h"
#include "runtime/effects/effects.h"
#include "runtime/effects/shared_settings.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/own_setting.h"
#include "runtime/light/shadow_maps.h"

namespace blush {
namespace {

constexpr std::array<std::string_view, 2> method_choices = {"maps", "off"};
constexpr std::array<std::string_view, 3> size_choices = {"512", "1024", "2048"};
constexpr std::array<std::string_view, 2> edge_choices = {"soft", "sharp"};
constexpr std::array<Setting, 3> settings = {{
    {"method", "maps: a shadow map for each light that casts one; off: light goes through everything", method_choices,
     0},
    {"size", "texels along a side of a light's map: 512, 1024 or 2048", size_choices, 1},
    {"edges", "soft: as wide as the light's size and the distance of what casts them make them; sharp: as the map is",
     edge_choices, 0},
}};
using Own = OwnSetting<shadows_effect, settings>;

Need need(const FrameState& frame) {
    if (frame.scene->settings.choice(Own("method")) == 1) {
        return {.on = false, .reason = "shadows.method is off", .can_be_forced = false};
    }
    if (frame.lights.empty()) return {.on = false, .reason = "no light shines", .can_be_forced = false};
    if (frame.scene->own<ShadowMaps>().maps.empty()) {
        return {.on = false, .reason = "no light that shines casts shadows", .can_be_forced = false};
    }
    if (shadow_maps_current(frame)) {
        return {.on = false, .reason = "neither lights nor surface moved since the maps that stand were drawn"};
    }
    return {.on = true, .reason = "a light casts shadows, and lights or surface moved"};
}

/// Makes the texture large enough for this frame's tiles.
void ensure_maps(FrameState& frame, ShadowMaps& maps) {
    gl::require_program(maps.program, {"light/shadow.vert"});
    require_hair_cores(frame, SeenFrom::light);
    if (!maps.framebuffer) {
        maps.framebuffer = gl::make_framebuffer();
        maps.nearest = gl::make_sampler();
        glSamplerParameteri(maps.nearest.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glSamplerParameteri(maps.nearest.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    std::uint32_t width = 0, height = 0;
    for (const ShadowMaps::Map& map : maps.maps) {
        width = std::max(width, map.tile.x + map.tile.side);
        height = std::max(height, map.tile.y + map.tile.side);
    }
    if (maps.width == width && maps.height == height) return;
    maps.depth = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(maps.depth.name(), 1, GL_DEPTH_COMPONENT32F, static_cast<GLsizei>(width),
                       static_cast<GLsizei>(height));
    glNamedFramebufferTexture(maps.framebuffer.name(), GL_DEPTH_ATTACHMENT, maps.depth.name(), 0);
    maps.width = width;
    maps.height = height;
}

void draw_maps(FrameState& frame) {
    auto& maps = frame.scene->own<ShadowMaps>();
    forget_program(frame);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, maps.framebuffer.name());
    const float far_depth = 1;
    glClearNamedFramebufferfv(maps.framebuffer.name(), GL_DEPTH, 0, &far_depth);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_DEPTH_CLAMP);  // what stands before or behind the map's range still casts
    for (const Casters casters : all_casters) {
        for (const ShadowMaps::Map& map : maps.maps) {
            const auto side = static_cast<GLsizei>(map.tile.side);
            glViewport(static_cast<GLint>(map.tile.x), static_cast<GLint>(map.tile.y), side, side);
            for (CharacterState* caster : frame.characters) {
                if (!casts_into(frame.lights[map.light], *caster, *frame.characters[map.character])) continue;
                draw_casters(frame, *caster, casters, maps.program, map.place.shadow_from_world);
            }
        }
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_DEPTH_TEST);
    keep_shadow_maps(frame);
}

void declare(FrameState& frame) {
    if (frame.picture > 0) return;  // the frame's first picture drew them: only the camera differs
    auto& maps = frame.scene->own<ShadowMaps>();
    ensure_maps(frame, maps);
    frame.resources.shadow_maps =
        frame.graph.import_texture("shadow maps", maps.depth.name(), {PixelFormat::depth32f, maps.width, maps.height});
    frame.graph.pass("shadow maps", [&frame](const FrameGraph&) { draw_maps(frame); });
    for (const CharacterState* character : frame.characters) frame.graph.reads(character->resources.positions);
    frame.graph.writes(frame.resources.shadow_maps);
}

const Lighting& light_inside() {
    static const Lighting lighting = [] {
        Lighting inside;
        LightSource light;
        light.kind = LightKind::point;
        light.position_world = {0, 0, 0.2F};
        inside.lights = {light};
        return inside;
    }();
    return lighting;
}

const Lighting& odd_lights() {
    static const Lighting lighting = [] {
        Lighting odd;
        LightSource dark, nan, still, far_spot, vertical;
        dark.radiance_linear = glm::vec3(0);
        nan.radiance_linear = glm::vec3(std::numeric_limits<float>::quiet_NaN());
        still.direction_world = glm::vec3(0);
        far_spot.kind = LightKind::spot;
        far_spot.position_world = {0, 0, 1e6F};
        far_spot.reference_distance = 1e6F;
        far_spot.outer_radians = 1e-4F;
        vertical.direction_world = {0, -1, 0};
        odd.lights = {dark, nan, still, far_spot, vertical};
        return odd;
    }();
    return lighting;
}

const Lighting& no_light() {
    static const Lighting lighting;
    return lighting;
}

constexpr std::array<HardCase, 3> hard_cases = {{
    {"no light at all", "a black face", [](Face&) {}, 0, [](ViewFrame& view) { view.lighting = &no_light(); }},
    {"a light inside the face", "lit, without a map", [](Face&) {}, 0,
     [](ViewFrame& view) { view.lighting = &light_inside(); }},
    {"dark, NaN, still and far lights", "those that cannot shine are left out", [](Face&) {}, 1,
     [](ViewFrame& view) { view.lighting = &odd_lights(); }},
}};

/// Maps that stand are read without being drawn.
bool takes_part(const FrameState& /*frame*/, const CharacterState& character) { return character.shadow_lights > 0; }

void bind(FrameState& frame, CharacterState& /*character*/, std::uint32_t unit) {
    const auto& maps = frame.scene->own<ShadowMaps>();
    glBindTextureUnit(unit, maps.depth.name());
    glBindSampler(unit, maps.nearest.name());
}

void reads(FrameState& frame) {
    if (frame.on(shadows_effect)) frame.graph.reads(frame.resources.shadow_maps);
}

constexpr std::array<std::string_view, 1> hooks = {"lit"};
constexpr ShadingPart shading = {
    .file = "light/shadow.glsl",
    .hooks = hooks,
    .takes_part = takes_part,
    .textures = 1,
    .bind = bind,
    .reads = reads,
};

}  // namespace

constinit const SettingId shadows_method = Own("method");
constinit const SettingId shadows_size = Own("size");
constinit const SettingId shadows_edges = Own("edges");

const Effect shadows_effect = {
    .name = "shadows",
    .what = "lights cast shadows and shine through thin parts",
    .settings = settings,
    .owner = SettingOwner::scene,
    .stage = Stage::light,
    .find_in_view = place_shadow_maps,
    .need = need,
    .declare = declare,
    .shading = &shading,
    .hard_cases = hard_cases,
};

}  // namespace blush
