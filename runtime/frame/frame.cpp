#include "runtime/frame/frame.h"

#include <algorithm>
#include <cassert>

#include "runtime/antialias/last_frame.h"
#include "runtime/antialias/pictures.h"
#include "runtime/frame/effect.h"
#include "runtime/frame/on_screen.h"
#include "runtime/light/scene_lights.h"
#include "runtime/light/shadow_maps.h"

namespace blush {
namespace {

void find_facts(CharacterState& state, const View& view) {
    find_active(state.pose.weights, state.active);
    state.facts = {};
    state.facts.active_targets = static_cast<std::uint32_t>(state.active.size());
    state.facts.has_joints = !state.face.joints.empty();
    state.facts.has_triangles = std::ranges::any_of(
        state.face.primitives, [](const Primitive& primitive) { return primitive.index_count >= 3; });
    state.facts.forced = view.force_effects;

    const NormalMethod method =
        static_cast<NormalMethod>(state.settings.choice(normals_effect.name, normals_effect.settings[0].name));
    const auto& needs =
        method == NormalMethod::authored ? state.target_needs_turned_normals : state.target_moves_normals;
    state.facts.any_turned_normals = std::ranges::any_of(needs, [](std::uint8_t need) { return need != 0; });
    state.facts.active_need_turned_normals =
        std::ranges::any_of(state.active, [&](const ActiveTarget& entry) { return needs[entry.target] != 0; });

    const bool same_settings = state.deformed_settings == state.settings;
    state.facts.deformation_current = state.deformed_valid && same_settings && state.active == state.deformed_active;
    state.normal_method = method;
}

/// Lights, skin and shadows; needs where every node stands.
void place_lights_and_skin(CharacterState& state, const View& view) {
    if (view.lighting == nullptr) state.portrait = portrait_lighting(view.camera);
    state.lighting = view.lighting != nullptr ? view.lighting : &state.portrait;
    usable_lights(*state.lighting, view.time_seconds, state.lights);
    place_skin(state);
    place_shadow_maps(state);
    state.shadows_shown = state.settings.choice(shadows_effect.name, "method") == 0 && shadow_light_count(state) > 0;
}

/// Effects that run must leave the same picture as effects that were left out; what they leave is remembered here.
void remember_deformation(CharacterState& state) {
    if (state.facts.active_targets == 0 && !state.facts.forced) return;  // the rest surface was used as it is
    state.deformed_active = state.active;
    state.deformed_settings = state.settings;
    state.deformed_valid = true;
}

/// What the surface passes start from, or what they have left for a further picture of the same frame.
void import_surface(CharacterState& state, const SurfaceBuffers& surface) {
    const auto count = static_cast<std::uint32_t>(state.face.positions.size());
    state.surface = &surface;
    state.resources = {};
    state.resources.positions = state.graph.import_buffer("surface positions", surface.positions.name(), 3, count);
    state.resources.normals = state.graph.import_buffer("surface normals", surface.normals.name(), 3, count);
    state.resources.tangents = state.graph.import_buffer("surface tangents", surface.tangents.name(), 4, count);
    state.resources.morphed_positions = state.resources.positions;
    state.resources.morphed_normals = state.resources.normals;
    state.resources.morphed_tangents = state.resources.tangents;
}

TextureShape picture_shape(const View& view) { return {picture_format(view.output), view.width, view.height, 1}; }

/// The image that has `left` steps after it.
ResourceId image(CharacterState& state, std::uint32_t left) {
    if (left == 0) return state.resources.target;
    const TextureShape shape = picture_shape(*state.view);
    if (left != state.kept_at) return state.graph.texture("display", shape);
    return state.graph.import_texture("kept image", kept_image(state, shape).color.name(), shape);
}

/// Counts the steps that the picture takes from the scene to its target, each of which calls next_display() once.
void count_images(CharacterState& state, const View& view, bool last_picture) {
    const auto on = [&](Stage stage) {
        return static_cast<std::uint32_t>(std::ranges::count_if(
            effects(), [&](const Effect* effect) { return effect->stage == stage && state.on(*effect); }));
    };
    const bool keeps = last_picture && state.sampling.temporal;
    const std::uint32_t display_steps = last_picture && view.output == Output::display_srgb ? on(Stage::display) : 0;
    state.kept_at = keeps ? 1 + display_steps : 0;
    state.images_left =
        on(Stage::filter) + (state.picture > 0 ? on(Stage::average) : 0) + (keeps ? 1 : 0) + display_steps;
}

/// An image that shading writes, and the one that it is resolved to: the same one where `shape` has one sample.
ResourceId shaded_image(CharacterState& state, std::string_view multisampled, std::string_view single,
                        TextureShape shape) {
    const ResourceId from = state.graph.texture(multisampled, shape);
    ResourceId to = from;
    if (shape.samples > 1) {
        shape.samples = 1;
        to = state.graph.texture(single, shape);
    }
    state.resources.to_resolve[state.resources.resolve_count++] = {from, to};
    return to;
}

void run(CharacterState& state, const View& view) {
    state.graph.compile();
    state.timers.clear();
    const auto before = [&state, &view](const FrameGraph&, const FramePass&) {
        if (view.timed) state.timers.start();
    };
    const auto after = [&state, &view](const FrameGraph& graph, const FramePass& pass) {
        if (view.timed) state.timers.stop();
        if (view.check_finite && !state.report.not_finite)
            state.report.not_finite = state.finite_check.scan(graph, pass);
    };
    state.graph.execute(state.textures, before, after);

    std::size_t timer = 0;
    for (const FramePass& pass : state.graph.passes()) {
        const double milliseconds = view.timed && pass.live ? state.timers.milliseconds(timer++) : 0;
        state.report.passes.push_back({pass.name, pass.live, milliseconds});
    }
}

}  // namespace

void begin_frame(CharacterState& state, const View& view) {
    state.view = &view;
    state.rig.evaluate(state.controls, state.pose);
    if (state.blood) state.blood->apply(state.pose);
    find_facts(state, view);
    world_from_nodes(state.face, state.pose, state.head_and_eyes, state.world_from_node);
    skinned_from_meshes(state.face, state.world_from_node, state.skinned_from_mesh);
    place_lights_and_skin(state, view);
    state.report.active = state.active;
    state.report.deltas_added = 0;
    state.report.triangles_drawn = 0;
    state.report.passes.clear();
    state.report.not_finite.reset();
}

void find_needs(CharacterState& state) {
    state.report.effects.clear();
    for (const Effect* effect : effects()) {
        const Need need = effect->need(state);
        const bool on = need.on || (state.facts.forced && need.can_be_forced);
        const std::string_view reason = on && !need.on ? "forced on" : need.reason;
        state.report.effects.push_back({effect->name, on, reason, need.omission, need.bound, need.bound_unit});
    }
}

bool CharacterState::on(const Effect& effect) const {
    const auto entry = std::ranges::find(report.effects, effect.name, &EffectReport::effect);
    return entry != report.effects.end() && entry->on;
}

void declare_stage(CharacterState& state, Stage stage) {
    for (const Effect* effect : effects()) {
        if (effect->stage == stage && state.on(*effect)) effect->declare(state);
    }
}

DisplayImages next_display(CharacterState& state) {
    assert(state.images_left > 0 && "next_display() is for the steps that count_images() counts, once each");
    const ResourceId from = state.resources.display;
    state.resources.display = image(state, --state.images_left);
    return {from, state.resources.display};
}

void bind_output(CharacterState& state, const FrameGraph& graph, ResourceId image) {
    const FrameResource& resource = graph[image];
    GLuint framebuffer = resource.handle;
    if (resource.kind == ResourceKind::texture) {
        framebuffer = state.output_framebuffer.name();
        glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, resource.handle, 0);
    }
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(resource.shape.width), static_cast<GLsizei>(resource.shape.height));
}

void draw_screen(const CharacterState& state) {
    glBindVertexArray(state.no_attributes.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

namespace {

void declare_picture(CharacterState& state, const View& view) {
    const bool last_picture = state.picture + 1 == state.sampling.pictures;
    const std::uint32_t phase = state.own<LastFrame>().phase;
    state.camera =
        jittered(view.camera, state.sampling.sample_offset_pixels(state.picture, phase), view.width, view.height);
    if (state.picture == 0) {
        import_surface(state, state.morphed());
        declare_stage(state, Stage::surface);
    } else {
        import_surface(state, *state.surface);
    }
    state.resources.shadow_maps = state.graph.import_framebuffer("shadow maps", 0, {});
    state.resources.blood_change = state.graph.import_framebuffer("blood", 0, {});
    declare_stage(state, Stage::light);

    const TextureShape color{PixelFormat::rgba16f, view.width, view.height, state.sampling.samples};
    TextureShape depth = color;
    depth.format = PixelFormat::depth32f;
    state.resources.scene_color = shaded_image(state, "scene colour, multisampled", "scene colour", color);
    state.resources.scene_color_multisampled = state.resources.to_resolve[0].from;
    state.resources.scene_depth = last_picture && state.sampling.temporal ? import_kept_depth(state, depth)
                                                                          : state.graph.texture("scene depth", depth);
    if (state.on(scattering_effect)) {
        TextureShape skin_depth = color;
        skin_depth.format = PixelFormat::r32f;
        state.resources.skin_light = shaded_image(state, "skin light, multisampled", "skin light", color);
        state.resources.skin_albedo = shaded_image(state, "skin albedo, multisampled", "skin albedo", color);
        state.resources.skin_depth = shaded_image(state, "skin depth, multisampled", "skin depth", skin_depth);
    }
    state.resources.target = last_picture
                                 ? state.graph.import_framebuffer("view", view.framebuffer, picture_shape(view))
                                 : picture_store(state, picture_shape(view), state.graph);
    count_images(state, view, last_picture);

    declare_shade(state);
    declare_stage(state, Stage::resolve);
    declare_stage(state, Stage::scene);
    state.resources.display = image(state, state.images_left);
    if (view.output == Output::display_srgb) {
        declare_tone(state, state.resources.display);
    } else if (state.images_left == 0 || state.images_left == state.kept_at) {
        declare_copy(state, state.resources.scene_color, state.resources.display);
    } else {
        state.resources.display = state.resources.scene_color;
    }
    declare_stage(state, Stage::filter);
    if (state.picture > 0) declare_stage(state, Stage::average);
    if (last_picture) {
        declare_stage(state, Stage::history);
        if (state.sampling.temporal && !state.on(reprojection_effect)) {
            const DisplayImages images = next_display(state);
            declare_copy(state, images.from, images.to);
        }
        if (view.output == Output::display_srgb) declare_stage(state, Stage::display);
    }
    state.graph.present(state.resources.target);
}

}  // namespace

void draw_frame(CharacterState& state, const View& view) {
    begin_frame(state, view);
    const auto largest = static_cast<std::uint32_t>(std::max(1, state.device.info().largest_sample_count));
    state.facts.on_screen = state.facts.has_triangles && (state.facts.forced || may_be_on_screen(state, view));
    state.sampling = find_sampling(state.settings, view, largest, state.facts.on_screen);
    find_last_frame(state, view);
    state.report.incomplete = state.sampling.temporal && !state.facts.has_last_frame;
    find_needs(state);
    state.translucency_shown = state.shadows_shown && state.on(translucency_effect);
    begin_pictures(state);
    for (state.picture = 0; state.picture < state.sampling.pictures; ++state.picture) {
        state.graph.clear();
        declare_picture(state, view);
        run(state, view);
    }
    remember_deformation(state);
    keep_for_next_frame(state, view);
}

void deform_only(CharacterState& state) {
    static const View no_view;
    begin_frame(state, no_view);
    state.sampling = {};
    state.graph.clear();
    find_needs(state);
    import_surface(state, state.morphed());
    declare_stage(state, Stage::surface);
    state.graph.present(state.resources.morphed_positions);
    state.graph.present(state.resources.morphed_normals);
    state.graph.present(state.resources.morphed_tangents);
    run(state, no_view);
    remember_deformation(state);
}

}  // namespace blush
