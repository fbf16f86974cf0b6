#include "runtime/frame/frame.h"

#include <algorithm>
#include <cassert>

#include "runtime/antialias/last_frame.h"
#include "runtime/antialias/pictures.h"
#include "runtime/deform/pinned_surface.h"
#include "runtime/draw/shading.h"
#include "runtime/frame/begin_view.h"
#include "runtime/frame/needs.h"

namespace blush {
namespace {

/// Effects that run must leave the same picture as effects that were left out; what they leave is remembered here.
void remember_surface(CharacterState& character) {
    const std::span<const Effect* const> registry = effects();
    for (std::size_t e = 0; e < registry.size(); ++e) {
        if (registry[e]->finish != nullptr && character.effects_on[e] != 0) registry[e]->finish(character);
    }
    // At rest the rest surface was used as it is.
    if (character.facts.active_targets == 0 && !character.facts.forced) return;
    character.deformed_active = character.active();
    character.deformed_settings = character.settings;
    character.deformed_valid = true;
}

/// What the surface passes start from, or what they have left for a further picture of the same frame.
void import_surface(FrameState& frame, CharacterState& character) {
    if (frame.picture == 0) {
        const bool made = character.facts.skinned && !character.facts.forced;
        character.surface = made ? &character.stream_out.skinned() : &character.morphed();
        if (character.facts.pins_applied && !character.facts.forced) character.surface = &character.pinned->surface;
    }
    const SurfaceBuffers& surface = *character.surface;
    const auto count = static_cast<std::uint32_t>(character.face.positions.size());
    auto& resources = character.resources;
    resources = {};
    resources.positions = frame.graph.import_buffer("surface positions", surface.positions.name(), 3, count);
    resources.normals = frame.graph.import_buffer("surface normals", surface.normals.name(), 3, count);
    resources.tangents = frame.graph.import_buffer("surface tangents", surface.tangents.name(), 4, count);
    resources.morphed_positions = resources.positions;
    resources.morphed_normals = resources.normals;
    resources.morphed_tangents = resources.tangents;
}

TextureShape picture_shape(const ViewFrame& view) { return {picture_format(view.output), view.width, view.height, 1}; }

/// An image that shading writes, and the one that it is resolved to: the same one where `shape` has one sample.
ResourceId shaded_image(FrameState& frame, std::string_view multisampled, std::string_view single, TextureShape shape) {
    const ResourceId from = frame.graph.texture(multisampled, shape);
    ResourceId to = from;
    if (shape.samples > 1) {
        shape.samples = 1;
        to = frame.graph.texture(single, shape);
    }
    frame.resources.to_resolve[frame.resources.resolve_count++] = {from, to};
    return to;
}

bool has_its_programs(const FrameState& frame) {
    return !frame.shared.programs.failed() && !frame.shared.programs.postponed();
}

void run(FrameState& frame, const ViewFrame& view) {
    frame.graph.compile();
    frame.timers.clear();
    const auto before = [&frame, &view](const FrameGraph&, const FramePass&) {
        if (view.timed) frame.timers.start();
    };
    const auto after = [&frame, &view](const FrameGraph& graph, const FramePass& pass) {
        if (view.timed) frame.timers.stop();
        if (view.check_finite && !frame.report.not_finite)
            frame.report.not_finite = frame.finite_check.scan(graph, pass);
    };
    frame.graph.execute(frame.shared.textures, before, after);
    // The host's further attachments were spared; those of the next picture's passes are ours.
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

    std::size_t timer = 0;
    for (const FramePass& pass : frame.graph.passes()) {
        const double milliseconds = view.timed && pass.live ? frame.timers.milliseconds(timer++) : 0;
        frame.report.passes.push_back({pass.name, pass.live, milliseconds});
    }
}

/// Ends the picture in `target`: what was made last goes there at once where it fills the host's framebuffer, or is
/// laid into it.
void declare_end(FrameState& frame, const ViewFrame& view, bool last_picture) {
    FrameGraph& graph = frame.graph;
    FrameResources& resources = frame.resources;
    if (!last_picture) {
        const ResourceId store = picture_store(frame, picture_shape(view), graph);
        if (resources.display == resources.scene_color) {
            declare_copy(frame, resources.display, store);
        } else {
            graph.forward(resources.display, store);
        }
        graph.present(store);
        return;
    }
    const ResourceId target = graph.import_framebuffer("view", view.framebuffer, picture_shape(view));
    const bool fills = view.backdrop == Backdrop::color && view.x == 0 && view.y == 0;
    const bool shown_elsewhere = resources.display == resources.scene_color || graph[resources.display].imported;
    if (fills && !shown_elsewhere) {
        graph.forward(resources.display, target);
    } else {
        declare_compose(frame, resources.display, target);
    }
    if (view.host_depth == HostDepth::read_and_write) declare_write_depth(frame, target);
    graph.present(target);
}

void declare_scene_images(FrameState& frame, const ViewFrame& view, bool last_picture) {
    FrameResources& resources = frame.resources;
    const TextureShape color{PixelFormat::rgba16f, view.width, view.height, frame.sampling.samples};
    TextureShape depth = color;
    depth.format = PixelFormat::depth32f;
    resources.scene_color = shaded_image(frame, "scene colour, multisampled", "scene colour", color);
    resources.scene_color_multisampled = resources.to_resolve[0].from;
    resources.scene_depth = last_picture && frame.sampling.temporal ? import_kept_depth(frame, depth)
                                                                    : frame.graph.texture("scene depth", depth);
    each_shading_target(frame, [&](const Effect& effect, const ShadingTarget& target, std::size_t) {
        TextureShape shape = color;
        shape.format = target.format;
        resources.targets[resources.target_count++] = {
            &effect, shaded_image(frame, target.multisampled_name, target.name, shape)};
    });
}

void declare_picture(FrameState& frame, const ViewFrame& view) {
    const bool last_picture = frame.picture + 1 == frame.sampling.pictures;
    const std::uint32_t phase = frame.own<LastFrame>().phase;
    frame.camera = view.camera;
    frame.camera.clip_from_view = frame.clip_from_view;
    frame.camera =
        jittered(frame.camera, frame.sampling.sample_offset_pixels(frame.picture, phase), view.width, view.height);
    frame.resources = {};
    for (CharacterState* character : frame.characters) import_surface(frame, *character);
    if (frame.picture == 0) declare_stage(frame, Stage::surface);
    declare_stage(frame, Stage::light);
    declare_scene_images(frame, view, last_picture);
    if (view.host_depth != HostDepth::none) declare_read_depth(frame, frame.resources.scene_depth);

    declare_shade(frame);
    declare_stage(frame, Stage::resolve);
    declare_stage(frame, Stage::scene);
    frame.resources.display = frame.resources.scene_color;
    if (view.output == Output::display_srgb) {
        frame.resources.display = frame.graph.texture("display", picture_shape(view));
        declare_tone(frame, frame.resources.display);
    }
    declare_stage(frame, Stage::filter);
    if (frame.picture > 0) declare_stage(frame, Stage::average);
    if (last_picture) {
        if (frame.sampling.temporal) keep_display(frame);
        declare_stage(frame, Stage::history);
        if (view.output == Output::display_srgb) declare_stage(frame, Stage::display);
    }
    declare_end(frame, view, last_picture);
}

}  // namespace

ResourceId FrameState::target(const Effect& effect, std::size_t k) const {
    const auto targets = std::span(resources.targets).first(resources.target_count);
    const auto first = std::ranges::find(targets, &effect, &FrameResources::Target::effect);
    assert(first != targets.end());
    return first[static_cast<std::ptrdiff_t>(k)].id;
}

void FrameState::drew(CharacterState& character, std::uint32_t triangles) {
    character.report->triangles_drawn += triangles;
    ++character.report->draws;
    report.triangles_drawn += triangles;
    ++report.draws;
}

void declare_stage(FrameState& frame, Stage stage) {
    for (const Effect* effect : effects()) {
        if (effect->stage == stage && effect->declare != nullptr && frame.on(*effect)) effect->declare(frame);
    }
}

DisplayImages next_display(FrameState& frame) {
    const ResourceId from = frame.resources.display;
    frame.resources.display = frame.graph.texture("display", picture_shape(*frame.view));
    return {from, frame.resources.display};
}

void bind_output(FrameState& frame, const FrameGraph& graph, ResourceId image) {
    const FrameResource& resource = graph[image];
    GLuint framebuffer = resource.handle;
    if (resource.kind == ResourceKind::texture) {
        framebuffer = frame.common->output.name();
        glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, resource.handle, 0);
    } else {
        constexpr GLuint most_attachments = 8;
        for (GLuint i = 1; i < most_attachments; ++i) glColorMaski(i, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    }
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, static_cast<GLsizei>(resource.shape.width), static_cast<GLsizei>(resource.shape.height));
}

void draw_screen(const FrameState& frame) {
    glBindVertexArray(frame.common->no_attributes.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void begin_scene_frame(SceneState& scene, bool next) {
    if (next) ++scene.frame;
    scene.kept.clear();
    scene.characters.clear();
    std::erase_if(scene.members, [](const std::weak_ptr<CharacterState>& member) { return member.expired(); });
    for (const std::weak_ptr<CharacterState>& member : scene.members) {
        scene.kept.push_back(member.lock());
        scene.characters.push_back(scene.kept.back().get());
        place_character(*scene.characters.back());
    }
}

void end_scene_frame(SceneState& scene, bool keep_surfaces) {
    if (keep_surfaces) {
        for (CharacterState* character : scene.characters) keep_surface(*character, scene.frame);
    }
    scene.kept.clear();
}

void draw_view(FrameState& frame, SceneState& scene, const ViewFrame& view) {
    const std::uint64_t compiled_before = frame.shared.programs.compiled();
    begin_view(frame, scene, view);
    if (make_common_passes(frame)) {
        const auto largest = static_cast<std::uint32_t>(std::max(1, frame.device.info().largest_sample_count));
        frame.sampling = find_sampling(frame.settings, view, largest, frame.facts.on_screen);
        find_last_frame(frame, view);
        frame.report.incomplete = frame.sampling.temporal && !frame.facts.has_last_frame;
        find_needs(frame);
        find_shading(frame);
        begin_pictures(frame);
        bool drawn = true;
        for (frame.picture = 0; drawn && frame.picture < frame.sampling.pictures; ++frame.picture) {
            frame.graph.clear();
            declare_picture(frame, view);
            // Without all of its programs a picture is not drawn: the report says why, or they are to come (warm_up()).
            drawn = has_its_programs(frame);
            if (drawn) run(frame, view);
        }
        if (drawn) {
            for (CharacterState* character : frame.characters) remember_surface(*character);
            keep_for_next_frame(frame);
        } else {
            frame.own<LastFrame>().known = false;
        }
    }
    frame.report.programs_compiled = static_cast<std::uint32_t>(frame.shared.programs.compiled() - compiled_before);
    if (std::optional<Error> failure = frame.shared.programs.take_failure()) frame.report.failure = failure->message;
}

void hand_over_view(FrameState& frame, SceneState& scene, const ViewFrame& view) {
    begin_view(frame, scene, view);
    frame.sampling = {};
    frame.picture = 0;
    if (make_common_passes(frame)) {
        find_needs(frame);
        find_shading(frame);
        frame.graph.clear();
        frame.resources = {};
        for (CharacterState* character : frame.characters) import_surface(frame, *character);
        declare_stage(frame, Stage::surface);
        declare_stage(frame, Stage::light);
        declare_host_shading(frame);
        if (has_its_programs(frame)) {
            run(frame, view);
            for (CharacterState* character : frame.characters) remember_surface(*character);
        }
    }
    if (std::optional<Error> failure = frame.shared.programs.take_failure()) frame.report.failure = failure->message;
}

void deform_only(FrameState& frame, SceneState& scene, bool forced) {
    static const ViewFrame no_view;
    static const ViewFrame forced_view = [] {
        ViewFrame view;
        view.force_effects = true;
        return view;
    }();
    begin_scene_frame(scene, false);
    begin_view(frame, scene, forced ? forced_view : no_view);
    frame.sampling = {};
    frame.picture = 0;
    frame.graph.clear();
    find_needs(frame);
    for (CharacterState* character : frame.characters) import_surface(frame, *character);
    declare_stage(frame, Stage::surface);
    for (CharacterState* character : frame.characters) {
        const auto& resources = character->resources;
        for (const ResourceId id : {resources.positions, resources.normals, resources.tangents,
                                    resources.morphed_positions, resources.morphed_normals, resources.morphed_tangents})
            frame.graph.present(id);
    }
    run(frame, *frame.view);
    for (CharacterState* character : frame.characters) remember_surface(*character);
    scene.kept.clear();
}

}  // namespace blush