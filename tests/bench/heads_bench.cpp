// What scattering costs with one head on the screen and with five
// (jimenez-2012, 6.5: its share grows with the pixels of skin alone). The heads
// are nodes of one face that draw the same meshes, so that one frame draws all
// of them:
//
//   bench_heads [FACE.glb [ROUNDS [HEIGHT]]]
//
// Pictures are as wide as five heads, whole with their shoulders, side by side;
// each is as large as one alone. Counts of heads go round in every round.

#include <epoxy/gl.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/files/face_file.h"
#include "runtime/frame/frame_state.h"
#include "runtime/measure/portrait.h"
#include "runtime/offscreen.h"

namespace {

using namespace blush;

constexpr std::uint32_t most_heads = 5;

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

/// `count` copies of every node under roots that stand `apart` from one
/// another.
Face row_of_heads(const Face& face, std::uint32_t count, float apart) {
    Face row = face;
    row.nodes.clear();
    row.animations.clear();
    for (std::uint32_t copy = 0; copy < count; ++copy) {
        const auto root = static_cast<std::int32_t>(row.nodes.size());
        Node placed;
        placed.name = "head " + std::to_string(copy);
        placed.rest.translation.x = apart * (static_cast<float>(copy) - 0.5F * static_cast<float>(count - 1));
        row.nodes.push_back(placed);
        for (Node node : face.nodes) {
            node.parent = node.parent < 0 ? root : node.parent + root + 1;
            row.nodes.push_back(node);
        }
    }
    return row;
}

struct Heads {
    Portrait character;
    std::size_t skin_pixels = 0;
    std::vector<double> scatter_ms, shade_ms, rest_ms;
};

void fail(const std::string& message) {
    std::fprintf(stderr, "bench_heads: %s\n", message.c_str());
    std::exit(2);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string path = argc > 1 ? argv[1] : "";
    const int rounds = argc > 2 ? std::max(1, std::atoi(argv[2])) : 11;
    const auto height = static_cast<std::uint32_t>(argc > 3 ? std::clamp(std::atoi(argv[3]), 16, 1024) : 160);
    const Result<Face> face = load_face(path);
    if (!face) fail(face.error().message);
    if (!face->skins.empty())
        fail(path +
             ": a face with joints stands where they are, and not where its "
             "nodes are");
    Result<Device> device = Device::headless(false);
    if (!device) fail(device.error().message);

    // Half the head beside it, so that outlines do not meet; all counts are seen
    // through the same camera.
    const Bounds bounds = moving_bounds(*face);
    const float apart = 1.05F * bounds.size().x;
    const float aspect = std::clamp(most_heads * apart / bounds.size().y, 1.0F, 16.0F);
    const auto width = static_cast<std::uint32_t>(aspect * static_cast<float>(height));
    Result<Offscreen> offscreen = Offscreen::create(*device, width, height, Output::display_srgb);
    if (!offscreen) fail(offscreen.error().message);

    std::vector<Heads> heads;
    Camera camera;
    for (std::uint32_t count = 1; count <= most_heads; ++count) {
        Result<Portrait> character = Portrait::create(*device, row_of_heads(*face, count, apart));
        if (!character) fail(character.error().message);
        const double scale = face_scale(*face).millimetres_a_unit;
        if (Status set = character->set("scattering.millimetres_a_unit", std::to_string(scale)); !set)
            fail(set.error().message);
        if (count == 1) camera = frame_head(bounds, {}, aspect).camera(aspect);
        heads.push_back({*std::move(character), 0, {}, {}, {}});
    }
    for (int round = -1; round < rounds; ++round) {
        for (Heads& row : heads) {
            ViewFrame view = offscreen->view();
            view.camera = camera;
            view.samples = 1;
            view.timed = true;
            const FrameReport& report = row.character.draw(view);
            glFinish();
            if (round < 0) continue;  // what is made at first
            double scatter = 0, shade = 0, rest = 0;
            for (const PassReport& pass : report.passes) {
                (pass.name == "scatter" ? scatter : pass.name == "shade" ? shade : rest) += pass.milliseconds;
            }
            row.scatter_ms.push_back(scatter);
            row.shade_ms.push_back(shade);
            row.rest_ms.push_back(rest);
        }
    }
    // Pixels of skin: those that scattering changes.
    for (Heads& row : heads) {
        ViewFrame view = offscreen->view();
        view.camera = camera;
        view.samples = 1;
        row.character.draw(view);
        const Image with = offscreen->read();
        if (Status set = row.character.set("scattering.albedo_before", "1"); !set) fail(set.error().message);
        if (Status set = row.character.set("scattering.method", "off"); !set) fail(set.error().message);
        row.character.draw(view);
        const Image without = offscreen->read();
        for (std::size_t p = 0; p < with.bytes.size(); p += 4) {
            if (!std::equal(&with.bytes[p], &with.bytes[p] + 3, &without.bytes[p])) ++row.skin_pixels;
        }
    }
    std::printf("%s, %u x %u pixels, %s, %d rounds\n", path.c_str(), width, height, device->info().renderer.c_str(),
                rounds);
    std::printf(
        "heads  skin pixels  scatter ms (quartiles)     frame ms  share "
        "%%  scatter / one head (quartiles)  per pixel / one head\n");
    bool grows = true;
    for (std::size_t n = 0; n < heads.size(); ++n) {
        const Heads& row = heads[n];
        std::vector<double> share, ratio, frame;
        for (std::size_t r = 0; r < row.scatter_ms.size(); ++r) {
            frame.push_back(row.scatter_ms[r] + row.shade_ms[r] + row.rest_ms[r]);
            share.push_back(100 * row.scatter_ms[r] / frame.back());
            ratio.push_back(row.scatter_ms[r] / heads[0].scatter_ms[r]);
        }
        const double pixels = static_cast<double>(row.skin_pixels) / static_cast<double>(heads[0].skin_pixels);
        std::printf(
            "%5zu  %11zu  %6.2f (%.2f to %.2f)  %10.1f  %7.1f  %6.2f (%.2f "
            "to %.2f)  %18.2f\n",
            n + 1, row.skin_pixels, quantile(row.scatter_ms, 0.5), quantile(row.scatter_ms, 0.25),
            quantile(row.scatter_ms, 0.75), quantile(frame, 0.5), quantile(share, 0.5), quantile(ratio, 0.5),
            quantile(ratio, 0.25), quantile(ratio, 0.75), quantile(ratio, 0.5) / pixels);
        grows = grows && (n == 0 || row.skin_pixels > heads[n - 1].skin_pixels);
    }
    if (!grows) fail("more heads do not cover more pixels: this table says nothing");
    return 0;
}
