// Renders one frame headless through the installed library. Exit status 0 when a face is to be seen.

#include <cstdio>
#include <set>

#include "rig/deform/rest_frame.h"
#include "runtime/character.h"
#include "runtime/device.h"
#include "runtime/files/face_file.h"
#include "runtime/files/output_file.h"
#include "runtime/offscreen.h"

namespace {

/// A pyramid whose tip a target lifts.
blush::Face pyramid() {
    blush::Face face;
    face.path = "pyramid";
    face.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
    face.indices = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    face.normals = blush::smooth_normals(face.positions, face.indices);
    face.uv0.assign(5, glm::vec2(0));
    face.uv1 = face.uv0;
    face.tangents = blush::tangents_from_uv(face.positions, face.normals, face.uv0, face.indices);
    face.primitives.push_back({.vertex_count = 5, .index_count = 12, .normal_source = blush::NormalSource::recomputed});
    face.meshes.push_back({"pyramid", 0, 1});
    blush::Node node;
    node.mesh = 0;
    face.nodes.push_back(node);
    blush::Target lift;
    lift.name = "lift";
    lift.vertices = {4};
    lift.position_deltas = {{0, 0.3F, 0}};
    face.targets.push_back(lift);
    return face;
}

int failed(const blush::Error& error) {
    std::fprintf(stderr, "engine: %s\n", error.message.c_str());
    return 1;
}

}  // namespace

int main() {
    const blush::Result<blush::Device> device = blush::Device::headless();
    if (!device) return failed(device.error());
    // A file that does not exist reaches the loaders, so that they are linked too.
    if (blush::load_face("there is no such file.glb")) return failed({"a missing file was loaded"});
    blush::Result<blush::Character> head = blush::Character::create(*device, pyramid());
    if (!head) return failed(head.error());
    const auto lift = head->control("lift");
    if (!lift) return failed({"no control called lift"});
    head->set(*lift, 0.5F);

    const blush::Result<blush::Offscreen> offscreen =
        blush::Offscreen::create(*device, 64, 64, blush::Output::display_srgb);
    if (!offscreen) return failed(offscreen.error());
    blush::View view = offscreen->view();
    view.camera = head->framing(1).camera(1);
    view.check_finite = true;
    const blush::FrameReport& report = head->draw(view);
    if (report.not_finite) return failed({report.not_finite->sentence()});
    if (report.deltas_added != 1) return failed({"the target was not added"});

    const blush::Image image = offscreen->read();
    std::set<unsigned> colours;
    for (std::size_t i = 0; i + 3 < image.bytes.size(); i += 4) {
        colours.insert((unsigned{image.bytes[i]} << 16) | (unsigned{image.bytes[i + 1]} << 8) | image.bytes[i + 2]);
    }
    constexpr std::size_t fewest_colours = 10;
    if (colours.size() < fewest_colours) return failed({"the picture is blank"});
    if (const blush::Status written = blush::write_image("frame.png", image); !written) return failed(written.error());
    for (const std::string& message : device->debug_messages()) return failed({"GL says: " + message});
    std::printf("engine: %zu colours\n", colours.size());
    return 0;
}
