/// Shadow maps of the lights: what shadows and light through thin parts are read from (chappuis-2011, 2.4).

#include <array>

#include "runtime/draw/draw_face.h"
#include "runtime/draw/hair_core.h"
#include "runtime/frame/frame.h"
#include "runtime/light/shadow_maps.h"
#include "runtime/measure/frame_study.h"

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

Need need(const CharacterState& state) {
    if (state.settings.choice("shadows", "method") == 1) {
        return {.on = false, .reason = "shadows.method is off", .can_be_forced = false};
    }
    if (state.lights.empty()) return {.on = false, .reason = "no light shines", .can_be_forced = false};
    if (shadow_light_count(state) == 0) {
        return {.on = false, .reason = "no light that shines casts shadows", .can_be_forced = false};
    }
    if (shadow_maps_current(state)) {
        return {.on = false, .reason = "neither lights nor surface moved since the maps that stand were drawn"};
    }
    return {.on = true, .reason = "a light casts shadows, and lights or surface moved"};
}

void ensure_maps(CharacterState& state, ShadowMaps& maps) {
    const std::uint32_t side = shadow_map_side(state), count = shadow_light_count(state);
    if (!maps.program) {
        Result<gl::Program> program = gl::make_program({"light/shadow.vert"});
        assert(program && "shadow.vert does not compile");
        maps.program = *std::move(program);
        maps.framebuffer = gl::make_framebuffer();
        maps.nearest = gl::make_sampler();
        glSamplerParameteri(maps.nearest.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glSamplerParameteri(maps.nearest.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    if (maps.side_texels == side && maps.count == count) return;
    maps.depth = gl::make_texture(GL_TEXTURE_2D);
    glTextureStorage2D(maps.depth.name(), 1, GL_DEPTH_COMPONENT32F, static_cast<GLsizei>(side * count),
                       static_cast<GLsizei>(side));
    glNamedFramebufferTexture(maps.framebuffer.name(), GL_DEPTH_ATTACHMENT, maps.depth.name(), 0);
    maps.side_texels = side;
    maps.count = count;
}

bool is_double_sided(const Face& face, const Primitive& primitive) {
    return primitive.material >= 0 && face.materials[static_cast<std::size_t>(primitive.material)].double_sided;
}

/// What is solid casts shadows; of cards only hair's opaque core does, or they would cast their whole outline.
bool is_solid(const Face& face, const Primitive& primitive) {
    return primitive.material < 0 ||
           face.materials[static_cast<std::size_t>(primitive.material)].alpha_mode == AlphaMode::opaque;
}

void draw_maps(CharacterState& state) {
    auto& maps = state.own<ShadowMaps>();
    ensure_maps(state, maps);
    maps.drawn_views.clear();
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, maps.framebuffer.name());
    const float far_depth = 1;
    glClearNamedFramebufferfv(maps.framebuffer.name(), GL_DEPTH, 0, &far_depth);
    write_draw_blocks(state);
    state.model.bind_surface(*state.surface);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_DEPTH_CLAMP);  // what stands before or behind the map's range still casts
    const auto side = static_cast<GLsizei>(maps.side_texels);
    for (const shared::Light& light : state.shader_lights) {
        if (light.shadow.x < 0) continue;
        glViewport(static_cast<GLint>(light.shadow.x) * side, 0, side, side);
        each_drawn_primitive(state, [&](const Primitive& primitive, std::size_t draw_index, bool mirrored) {
            const bool hair = is_hair_card(state, primitive);
            if (!hair && !is_solid(state.face, primitive)) return;
            if (hair) {
                bind_hair_core(state, primitive, SeenFrom::light);
            } else {
                glUseProgram(maps.program.name());
            }
            glUniformMatrix4fv(0, 1, GL_FALSE, &light.shadow_from_world[0][0]);
            // Only what light can meet from outside: through the open back of a shell it would come in at once, and
            // shine through the front as if that were thin.
            if (is_double_sided(state.face, primitive)) {
                glDisable(GL_CULL_FACE);
            } else {
                glEnable(GL_CULL_FACE);
            }
            glFrontFace(mirrored ? GL_CW : GL_CCW);
            state.model.bind_draw(draw_index);
            draw_elements(state, primitive);
        });
        maps.drawn_views.push_back(light.shadow_from_world);
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_DEPTH_TEST);
    maps.drawn_active = state.active;
    maps.drawn_settings = state.settings;
    maps.drawn_nodes = state.world_from_node;
    maps.drawn_joints = state.skinned_from_mesh;
    maps.valid = true;
}

void declare(CharacterState& state) {
    if (state.picture > 0) return;  // the frame's first picture drew them: only the camera differs
    state.graph.pass("shadow maps", [&state](const FrameGraph&) { draw_maps(state); })
        .reads(state.resources.positions)
        .writes(state.resources.shadow_maps);
}

std::vector<Study> studies(const Device& device, const Face& face, double millimetres_a_unit, bool /*quick*/) {
    std::vector<Study> result = frame_study(device, face, millimetres_a_unit,
                                            {"shadows.size", {"512", "1024", "2048"}, 1, "2048", &study_backlight()});
    for (Study& study : frame_study(device, face, millimetres_a_unit,
                                    {"shadows.edges", {"soft", "sharp"}, 0, "soft", &study_backlight()})) {
        result.push_back(std::move(study));
    }
    for (Study& study : frame_study(device, face, millimetres_a_unit,
                                    {"shadows.method", {"maps", "off"}, 0, "maps", &study_backlight()})) {
        result.push_back(std::move(study));
    }
    return result;
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
    {"no light at all", "a black face", [](Face&) {}, 0, [](View& view) { view.lighting = &no_light(); }},
    {"a light inside the face", "lit, without a map", [](Face&) {}, 0,
     [](View& view) { view.lighting = &light_inside(); }},
    {"dark, NaN, still and far lights", "those that cannot shine are left out", [](Face&) {}, 1,
     [](View& view) { view.lighting = &odd_lights(); }},
}};

}  // namespace

const Effect shadows_effect = {
    .name = "shadows",
    .what = "lights cast shadows and shine through thin parts",
    .settings = settings,
    .stage = Stage::light,
    .need = need,
    .declare = declare,
    .studies = studies,
    .hard_cases = hard_cases,
};

}  // namespace blush
