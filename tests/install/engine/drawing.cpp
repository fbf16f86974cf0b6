#include "drawing.h"

#include <glm/gtc/quaternion.hpp>

#include "rig/deform/rest_frame.h"
#include "runtime/offscreen.h"
#include "runtime/scene.h"

namespace {

/// A pyramid whose tip a target lifts.
blush::Face pyramid() {
    blush::Face face;
    face.path = "pyramid";
    face.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
    face.indices = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    face.normals = blush::smooth_normals(face.positions, face.indices);
    face.uv0.assign(5, blush::Vec2(0));
    face.uv1 = face.uv0;
    face.tangents = blush::tangents_from_uv(face.positions, face.normals, face.uv0, face.indices);
    face.primitives.push_back({.vertex_count = 5, .index_count = 12, .normal_source = blush::NormalSource::recomputed});
    face.meshes.push_back({"pyramid", 0, 1});
    blush::Node node;
    node.mesh = 0;
    const glm::quat turn = glm::angleAxis(0.3F, glm::vec3(0, 1, 0));
    node.rest.rotation = {turn.w, turn.x, turn.y, turn.z};
    face.nodes.push_back(node);
    blush::Target lift;
    lift.name = "lift";
    lift.vertices = {4};
    lift.position_deltas = {{0, 0.3F, 0}};
    face.targets.push_back(lift);
    return face;
}

}  // namespace

blush::Result<blush::Image> draw_pyramid(const blush::Device& device) {
    const blush::Result<blush::FaceAsset> asset = blush::FaceAsset::create(pyramid());
    if (!asset) return asset.error();
    blush::Result<blush::Character> head = blush::Character::create(device, *asset);
    if (!head) return head.error();
    blush::Result<blush::Scene> scene = blush::Scene::create(device);
    if (!scene) return scene.error();
    if (const blush::Status added = scene->add(*head); !added) return added.error();
    blush::Result<blush::View> view = blush::View::create(device);
    if (!view) return view.error();
    const auto lift = head->control("lift");
    if (!lift) return blush::Error{"no control called lift"};
    head->set(*lift, 0.5F);

    const blush::Result<blush::Offscreen> offscreen =
        blush::Offscreen::create(device, 64, 64, blush::Output::display_srgb);
    if (!offscreen) return offscreen.error();
    blush::ViewFrame frame = offscreen->view();
    frame.camera = asset->framing(1).camera(1);
    frame.check_finite = true;
    const blush::FrameReport& report = scene->draw(*view, frame);
    if (report.failure) return blush::Error{*report.failure};
    if (report.not_finite) return blush::Error{report.not_finite->sentence()};
    if (report.deltas_added != 1) return blush::Error{"the target was not added"};
    for (const std::string& message : device.debug_messages()) return blush::Error{"GL says: " + message};
    return offscreen->read();
}
