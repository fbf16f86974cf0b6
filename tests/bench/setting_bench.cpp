// What a setting costs: the frame with it minus the frame without it, drawn in turn.
//
//   bench_setting FACE.glb SETTING VALUE OTHER [LIGHTS [ROUNDS [SIDE]]]
//   bench_setting face.glb translucency.strength 1 0 behind
//
// Pictures are SIDE pixels wide and high, with the head near enough to fill them, so that pixels cost more than
// vertices; each round draws both frames, the order changing from round to round. LIGHTS as blush --lights has them.
// Processor time of all threads is what a software renderer takes whatever else the machine does; on a GPU look at the
// wall's.

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "runtime/files/face_file.h"
#include "runtime/files/lighting_file.h"
#include "runtime/measure/portrait.h"
#include "runtime/offscreen.h"

namespace {

using namespace blush;

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

void print(const char* what, const std::vector<double>& values, const char* unit) {
    std::printf("%-12s median %8.3f %s, quartiles %.3f to %.3f\n", what, quantile(values, 0.5), unit,
                quantile(values, 0.25), quantile(values, 0.75));
}

void fail(const std::string& message) {
    std::fprintf(stderr, "bench_setting: %s\n", message.c_str());
    std::exit(2);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 5) fail("FACE SETTING VALUE OTHER [LIGHTS [ROUNDS [SIDE]]]");
    const std::string setting = argv[2];
    const Result<Face> face = load_face(argv[1]);
    if (!face) fail(face.error().message);
    const Result<Lighting> lighting = named_lighting(argc > 5 ? argv[5] : "behind");
    if (!lighting) fail(lighting.error().message);
    const int rounds = argc > 6 ? std::max(1, std::atoi(argv[6])) : 41;
    const auto side = static_cast<std::uint32_t>(argc > 7 ? std::clamp(std::atoi(argv[7]), 16, 2048) : 256);
    Result<Device> device = Device::headless(false);
    if (!device) fail(device.error().message);
    Result<Offscreen> offscreen = Offscreen::create(*device, side, side, Output::display_srgb);
    if (!offscreen) fail(offscreen.error().message);

    std::vector<Portrait> characters;
    for (const char* value : {argv[3], argv[4]}) {
        Result<Portrait> character = Portrait::create(*device, *face);
        if (!character) fail(character.error().message);
        if (Status set = character->set(setting, value); !set) fail(set.error().message);
        characters.push_back(*std::move(character));
    }
    ViewFrame view = offscreen->view();
    OrbitCamera orbit = characters[0].framing(1);
    constexpr float nearness = 2.5F;
    orbit.vertical_field_of_view_radians /= nearness;
    view.camera = orbit.camera(1);
    view.lighting = &*lighting;
    std::vector<double> with_ms, without_ms, difference_ms, share_percent, processor_ms, processor_percent;
    for (int round = -1; round < rounds; ++round) {
        double ms[2] = {}, processor[2] = {};
        for (std::size_t turn = 0; turn < 2; ++turn) {
            const std::size_t which = (turn + static_cast<std::size_t>(round + 1)) % 2;
            const auto before = std::chrono::steady_clock::now();
            const std::clock_t processor_before = std::clock();
            characters[which].draw(view);
            glFinish();
            ms[which] = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count();
            processor[which] = 1000.0 * static_cast<double>(std::clock() - processor_before) / CLOCKS_PER_SEC;
        }
        if (round < 0) continue;  // what is made at first
        with_ms.push_back(ms[0]);
        without_ms.push_back(ms[1]);
        difference_ms.push_back(ms[0] - ms[1]);
        share_percent.push_back(100 * (ms[0] - ms[1]) / ms[0]);
        processor_ms.push_back(processor[0] - processor[1]);
        processor_percent.push_back(100 * (processor[0] - processor[1]) / processor[0]);
    }
    std::printf("%s, %u x %u pixels, %s, %d rounds, %s=%s against %s\n", argv[1], side, side,
                device->info().renderer.c_str(), rounds, setting.c_str(), argv[3], argv[4]);
    print("with", with_ms, "ms");
    print("without", without_ms, "ms");
    print("difference", difference_ms, "ms");
    print("share", share_percent, "% of the frame with it");
    print("processor", processor_ms, "ms, the difference");
    print("share", processor_percent, "% of the processor's time for the frame with it");
    return 0;
}
