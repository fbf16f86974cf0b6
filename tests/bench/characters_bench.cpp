// What further characters of one asset cost: to make, in memory, and in a frame.
//
//   bench_characters FACE.glb [ROUNDS [SIDE]]
//
// Characters stand in a square of 5 by 4 that fills the picture at every count, so that a frame of twenty shades no
// more pixels than twenty small heads have. Counts go round in every round; a character is made and destroyed in each
// as well.

#include <epoxy/gl.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "runtime/offscreen.h"
#include "runtime/scene.h"

namespace {

using namespace blush;

constexpr std::array<std::size_t, 4> counts = {1, 2, 5, 20};

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

double milliseconds_of(auto work) {
    const auto from = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - from).count();
}

[[noreturn]] void fail(const std::string& message) {
    std::fprintf(stderr, "bench_characters: %s\n", message.c_str());
    std::exit(2);
}

template <class T>
T need(Result<T> made) {
    if (!made) fail(made.error().message);
    return *std::move(made);
}

struct Crowd {
    std::vector<Character> characters;
    Scene scene;
    View view;
    std::vector<double> frame_ms;
    std::uint32_t passes = 0, draws = 0, switches = 0;
};

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) fail("usage: bench_characters FACE.glb [ROUNDS [SIDE]]");
    const int rounds = argc > 2 ? std::max(1, std::atoi(argv[2])) : 11;
    const auto side = static_cast<std::uint32_t>(argc > 3 ? std::clamp(std::atoi(argv[3]), 16, 2048) : 256);
    const Device device = need(Device::headless(false));
    const FaceAsset asset = need(FaceAsset::load(argv[1]));
    const Offscreen offscreen = need(Offscreen::create(device, side, side, Output::display_srgb));
    const Character first = need(Character::create(device, asset));  // makes what all share

    OrbitCamera orbit = asset.framing(1);
    const auto apart = static_cast<double>(orbit.distance) * 0.42;
    orbit.distance *= 5;
    orbit.scene_radius *= 6;
    std::vector<Crowd> crowds;
    for (const std::size_t count : counts) {
        crowds.push_back({{}, need(Scene::create(device)), need(View::create(device)), {}});
        Crowd& crowd = crowds.back();
        for (std::size_t c = 0; c < count; ++c) {
            crowd.characters.push_back(need(Character::create(device, asset)));
            const glm::dvec3 place(static_cast<double>(c % 5) - 2, 1.5 - static_cast<double>(c / 5), 0);
            crowd.characters.back().place(glm::translate(glm::dmat4(1), apart * place));
            if (Status added = crowd.scene.add(crowd.characters.back()); !added) fail(added.error().message);
        }
    }
    const struct mallinfo2 before = mallinfo2();
    constexpr int many = 20;
    {
        std::vector<Character> kept;
        for (int c = 0; c < many; ++c) kept.push_back(need(Character::create(device, asset)));
        const struct mallinfo2 after = mallinfo2();
        std::printf("%s, %zu vertices, %u x %u pixels, %s, %d rounds\n", argv[1], asset.face().positions.size(), side,
                    side, device.info().renderer.c_str(), rounds);
        // A software driver keeps its buffers on the same heap.
        std::printf("memory of a further character: %.1f KB\n",
                    static_cast<double>(after.uordblks + after.hblkhd - before.uordblks - before.hblkhd) / many / 1e3);
    }
    std::vector<double> made_ms;
    for (int round = -1; round < rounds; ++round) {
        for (Crowd& crowd : crowds) {
            for (std::size_t c = 0; c < crowd.characters.size(); ++c) {
                for (float& control : crowd.characters[c].controls()) control = 0;
                crowd.characters[c].controls()[(c + static_cast<std::size_t>(round + 1)) % 8] = 0.5F;
            }
            ViewFrame frame = offscreen.view();
            frame.samples = 1;
            frame.camera = orbit.camera(1);
            const double ms = milliseconds_of([&] {
                const FrameReport& report = crowd.scene.draw(crowd.view, frame);
                glFinish();
                if (report.failure) fail(*report.failure);
                crowd.passes = static_cast<std::uint32_t>(report.passes.size());
                crowd.draws = report.draws;
                crowd.switches = report.program_switches;
            });
            if (round >= 0) crowd.frame_ms.push_back(ms);  // the first round makes what is missing
        }
        const double ms = milliseconds_of([&] {
            const Character one = need(Character::create(device, asset));
            glFinish();
        });
        if (round >= 0) made_ms.push_back(ms);
    }
    std::printf("making one: %.3f ms (quartiles %.3f to %.3f)\n", quantile(made_ms, 0.5), quantile(made_ms, 0.25),
                quantile(made_ms, 0.75));
    std::printf("characters  frame ms (quartiles)        passes  draws  program switches\n");
    for (std::size_t k = 0; k < counts.size(); ++k) {
        const Crowd& crowd = crowds[k];
        std::printf("%10zu  %8.1f (%.1f to %.1f)  %6u %6u  %6u\n", counts[k], quantile(crowd.frame_ms, 0.5),
                    quantile(crowd.frame_ms, 0.25), quantile(crowd.frame_ms, 0.75), crowd.passes, crowd.draws,
                    crowd.switches);
    }
    return 0;
}
