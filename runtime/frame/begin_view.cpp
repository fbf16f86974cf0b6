#include "runtime/frame/begin_view.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/deform/pinned_surface.h"
#include "runtime/frame/effect.h"
#include "runtime/frame/on_screen.h"
#include "runtime/light/environment_map.h"

namespace blush {
namespace {

void find_facts(CharacterState& character, bool forced) {
    const std::vector<ActiveTarget>& active = character.active();
    CharacterFacts& facts = character.facts;
    facts = {};
    facts.active_targets = static_cast<std::uint32_t>(active.size());
    facts.has_joints = !character.face.joints.empty();
    facts.forced = forced;
    facts.deformation_current = character.deformed_valid && character.deformed_settings == character.settings &&
                                active == character.deformed_active;
    facts.skinned = character.skinned.valid && character.skinned.settings == character.settings &&
                    character.skinned.active == active &&
                    character.skinned.joints == character.stance.skinned_from_mesh;
    if (facts.active_targets != 0 || forced) character.stream_out.prepare();
    find_pins(character);
}

/// Clip space of the host's convention to GL's own: a linear map of z and w.
glm::mat4 gl_clip(const glm::mat4& clip_from_view, const DepthConvention& convention) {
    if (!convention.zero_to_one && !convention.reversed) return clip_from_view;
    glm::mat4 clip = clip_from_view;
    for (glm::length_t column = 0; column < 4; ++column) {
        float& z = clip[column][2];
        const float w = clip[column][3];
        if (convention.zero_to_one) z = 2 * z - w;
        if (convention.reversed) z = -z;
    }
    return clip;
}

void place_camera(FrameState& frame, const ViewFrame& view) {
    frame.view = &view;
    frame.camera = view.camera;
    frame.camera.clip_from_view = frame.clip_from_view = gl_clip(view.camera.clip_from_view, view.depth_convention);
    const glm::dvec3 eye(glm::inverse(view.camera.view_from_world)[3]);
    const bool finite = std::isfinite(eye.x) && std::isfinite(eye.y) && std::isfinite(eye.z);
    frame.eye_world = finite ? eye : glm::dvec3(0);
}

/// What depends on where this view's camera stands: places, skin, light.
void place_in_view(FrameState& frame) {
    for (CharacterState* character : frame.characters) {
        const glm::dvec3& middle = character->centre_world;
        const bool finite = std::isfinite(middle.x) && std::isfinite(middle.y) && std::isfinite(middle.z);
        character->origin_world = finite ? middle : glm::dvec3(0);
        const glm::dmat4 shading_from_world = glm::translate(glm::dmat4(1), -character->origin_world);
        character->view_from_shading =
            glm::mat4(frame.view->camera.view_from_world * glm::translate(glm::dmat4(1), character->origin_world));
        for (std::size_t n = 0; n < character->shading_from_node.size(); ++n) {
            character->shading_from_node[n] = glm::mat4(shading_from_world * character->stance.world_from_node[n]);
        }
        character->skin = place_skin(frame, *character);
        CharacterReport& report = *character->report;
        const LightsThatReach reach =
            lights_that_reach(frame.lights, character->centre_world, character->radius_world, character->reaching);
        report.lights = static_cast<std::uint32_t>(character->reaching.size());
        report.lights_left_out = reach.left_out;
        report.lights_left_out_radiance = reach.left_out_radiance;
        character->ambient_sh = ambient_sh(*frame.lighting);
        character->shader_lights.clear();
        for (const std::uint32_t l : character->reaching) {
            character->shader_lights.push_back(shader_light(frame.lights[l], character->origin_world));
        }
        character->shadow_lights = 0;
    }
}

void find_light(FrameState& frame, const ViewFrame& view) {
    frame.lighting = view.lighting;
    if (frame.lighting == nullptr && frame.scene->lighting) frame.lighting = &*frame.scene->lighting;
    if (frame.lighting == nullptr) {
        portrait_lighting(view.camera, frame.portrait);
        frame.lighting = &frame.portrait;
    }
    usable_lights(*frame.lighting, view.time_seconds, frame.lights);
}

void start_report(FrameState& frame) {
    FrameReport& report = frame.report;
    report.characters.resize(frame.characters.size());
    report.passes.clear();
    report.not_finite.reset();
    report.failure.reset();
    report.deltas_added = 0;
    report.triangles_drawn = report.draws = report.program_switches = 0;
    for (std::uint32_t c = 0; c < frame.characters.size(); ++c) {
        CharacterState& character = *frame.characters[c];
        character.index = c;
        character.report = &report.characters[c];
        character.report->active = character.active();
        character.report->deltas_added = 0;
        character.report->stream_outs = character.report->draws = character.report->triangles_drawn = 0;
    }
}

}  // namespace

void place_character(CharacterState& character) {
    character.rig.evaluate(character.controls, character.pose);
    if (character.blood) character.blood->apply(character.pose);
    find_stance(character, character.pose, character.face_from_node, character.stance);
    const AssetState& asset = character.facts_of_face;
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(character.world_from_face))));
    character.scale_of_place = scale > 0 && std::isfinite(scale) ? scale : 1;
    character.millimetres_a_unit = asset.scale.millimetres_a_unit / character.scale_of_place;
    const Bounds bounds = moved_bounds(character);
    character.centre_world = glm::dvec3(character.world_from_face * glm::dvec4(bounds.centre(), 1));
    // A little more than the bounds, so that a deformation that leaves them somewhat still casts its shadow.
    character.radius_world = bounds.empty() ? 0 : 0.55 * scale * static_cast<double>(glm::length(bounds.size()));
}

void begin_view(FrameState& frame, SceneState& scene, const ViewFrame& view) {
    frame.scene = &scene;
    frame.characters = scene.characters;
    start_report(frame);
    place_camera(frame, view);
    frame.facts = {};
    frame.facts.forced = view.force_effects;
    for (CharacterState* character : frame.characters) find_facts(*character, view.force_effects);
    for (const Effect* effect : effects()) {
        if (effect->find_facts != nullptr) effect->find_facts(frame);
    }
    find_light(frame, view);
    place_in_view(frame);
    for (CharacterState* character : frame.characters) {
        frame.facts.has_triangles |= character->facts_of_face.has_triangles;
        frame.facts.skin_on_screen |= character->skin.on_screen;
        character->report->on_screen =
            character->facts_of_face.has_triangles && (view.force_effects || may_be_on_screen(frame, *character));
        frame.facts.on_screen |= character->report->on_screen;
    }
    for (const Effect* effect : effects()) {
        if (effect->find_in_view != nullptr) effect->find_in_view(frame);
    }
}

}  // namespace blush
