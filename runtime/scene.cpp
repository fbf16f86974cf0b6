#include "runtime/scene.h"

#include <algorithm>
#include <array>

#include "runtime/antialias/last_frame.h"
#include "runtime/draw/draw_casters.h"
#include "runtime/draw/draw_face.h"
#include "runtime/draw/hair_core.h"
#include "runtime/frame/frame.h"
#include "runtime/frame/warm_up.h"
#include "runtime/gl/state_guard.h"
#include "runtime/light/shadow_maps.h"

namespace blush {
namespace {

bool has_pixels(const ViewFrame& frame) { return frame.width != 0 && frame.height != 0; }

/// A view of a scene's own, for what needs no picture.
FrameState& own_view(SceneState& scene) {
    std::shared_ptr<FrameState>& view = scene.own<std::shared_ptr<FrameState>>();
    if (!view) view = std::make_shared<FrameState>(scene.device);
    return *view;
}

}  // namespace

View::View(std::shared_ptr<FrameState> state) : state_(std::move(state)) {}

Result<View> View::create(const Device& device) { return View(on_device(new FrameState(device))); }

Status View::set(std::string_view setting, std::string_view choice) {
    return state_->settings.set(setting, choice, SettingOwner::view);
}

Scene::Scene(std::shared_ptr<SceneState> state) : state_(std::move(state)) {}

Result<Scene> Scene::create(const Device& device) { return Scene(on_device(new SceneState(device))); }

Status Scene::add(const Character& character) {
    const std::shared_ptr<CharacterState>& state = character.shared_state();
    if (&state->device.state() != &state_->device.state()) {
        return Error{"the character is of another device than the scene"};
    }
    const bool member = std::ranges::any_of(
        state_->members, [&state](const std::weak_ptr<CharacterState>& known) { return known.lock() == state; });
    if (!member) state_->members.push_back(state);
    return Done{};
}

void Scene::remove(const Character& character) {
    std::erase_if(state_->members, [&character](const std::weak_ptr<CharacterState>& known) {
        return known.lock() == character.shared_state();
    });
}

void Scene::set_lighting(std::optional<Lighting> lighting) { state_->lighting = std::move(lighting); }

Status Scene::set(std::string_view setting, std::string_view choice) {
    return state_->settings.set(setting, choice, SettingOwner::scene);
}

const FrameReport& Scene::draw(View& view, const ViewFrame& frame) {
    const std::array<ViewInFrame, 1> one = {{{view, frame}}};
    draw(one);
    return report(view);
}

void Scene::draw(std::span<const ViewInFrame> views) {
    if (std::ranges::none_of(views, [](const ViewInFrame& each) { return has_pixels(each.frame); })) {
        for (const ViewInFrame& each : views) each.view.state().report = {};
        return;
    }
    state_->device.make_current();
    const gl::DrawScope guard(state_->device.state().kept_states == 0);
    begin_scene_frame(*state_);
    bool compared = false;
    for (const ViewInFrame& each : views) {
        FrameState& view = each.view.state();
        if (!has_pixels(each.frame)) {
            view.report = {};
            continue;
        }
        draw_view(view, *state_, each.frame);
        // What was not drawn has not made its surfaces either.
        compared |= !view.report.failure && compares_frames(view, each.frame);
    }
    end_scene_frame(*state_, compared);
}

WarmUpProgress Scene::warm_up(View& view, const ViewFrame& like, std::uint32_t most_programs) {
    state_->device.make_current();
    const gl::DrawScope guard(state_->device.state().kept_states == 0);
    // What draw_depth() needs, whether or not a light of the scene casts shadows.
    require_hair_cores(own_view(*state_), SeenFrom::light);
    gl::require_program(state_->own<ShadowMaps>().program, {"light/shadow.vert"});
    return blush::warm_up(view.state(), *state_, like, std::max(1U, most_programs));
}

const FrameReport& Scene::report(const View& view) { return view.state().report; }

void Scene::draw_depth(const DepthFrame& depth) {
    if (depth.width == 0 || depth.height == 0) return;
    state_->device.make_current();
    const gl::DrawScope guard(state_->device.state().kept_states == 0);
    FrameState& frame = own_view(*state_);
    deform_only(frame, *state_);
    auto& maps = state_->own<ShadowMaps>();
    require_hair_cores(frame, SeenFrom::light);
    if (!gl::require_program(maps.program, {"light/shadow.vert"})) return;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, depth.framebuffer);
    glViewport(static_cast<GLint>(depth.x), static_cast<GLint>(depth.y), static_cast<GLsizei>(depth.width),
               static_cast<GLsizei>(depth.height));
    glClipControl(GL_LOWER_LEFT, depth.depth_convention.zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(depth.depth_convention.reversed ? GL_GREATER : GL_LESS);
    forget_program(frame);
    for (const Casters casters : all_casters) {
        for (CharacterState* character : state_->characters) {
            draw_casters(frame, *character, casters, maps.program, depth.clip_from_world);
        }
    }
}

const FrameReport& Scene::deform() {
    state_->device.make_current();
    const gl::StateGuard guard;
    FrameState& frame = own_view(*state_);
    deform_only(frame, *state_);
    return frame.report;
}

Scene::Surface Scene::read_deformed(const Character& character) {
    state_->device.make_current();
    const gl::DrawScope guard(state_->device.state().kept_states == 0);
    deform_only(own_view(*state_), *state_);
    const CharacterState& state = character.state();
    const std::size_t count = state.face.positions.size();
    Surface surface{std::vector<glm::vec3>(count), std::vector<glm::vec3>(count), std::vector<glm::vec4>(count)};
    const auto read = [](const gl::Buffer& buffer, auto& out) {
        glGetNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(out.size() * sizeof(out[0])), out.data());
    };
    // Pins come after joints: only without any is the pinned surface still in the mesh's space.
    const bool pinned = state.facts.pinned && !state.facts.has_joints && state.surface != nullptr;
    const SurfaceBuffers& buffers = pinned ? *state.surface : state.morphed();
    read(buffers.positions, surface.positions);
    read(buffers.normals, surface.normals);
    read(buffers.tangents, surface.tangents);
    for (const Primitive& primitive : state.face.primitives) {
        const glm::vec3 origin = state.facts_of_face.mesh_origin[primitive.mesh];
        if (origin == glm::vec3(0)) continue;
        for (std::uint32_t v = 0; v < primitive.vertex_count; ++v)
            surface.positions[primitive.first_vertex + v] += origin;
    }
    return surface;
}

}  // namespace blush
