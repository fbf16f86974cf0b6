/// bench_antialiasing_modes [ROUNDS [SIDE_PIXELS]]: what each mode of antialiasing adds to a frame of a moving face.
///
/// All modes run in turn in one process. Printed are the time of the frame; the time of what the mode adds to it behind
/// the scene (all passes but deformation, velocities, shading and tone, and without further pictures' shading); its
/// ratio to SMAA 1x with that of jimenez-2012, 10.5, beside it (1.02, 1.32, 2.04 and 2.34 ms on a GeForce GTX 470 at
/// 1080p; there the shading of the second sample does not count either, and drawing velocities does not); and the error
/// against the mean of 64 pictures. A picture without edges is measured too, and what a further character costs with
/// and without the programs of the ones before. Exit status 1 where a mode is further from the reference than one
/// sample a pixel.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <epoxy/gl.h>

#include "runtime/gl/program.h"
#include "runtime/measure/portrait.h"
#include "runtime/offscreen.h"
#include "tests/test_faces.h"

namespace {

using namespace blush;

struct Mode {
    const char* name;
    double paper_ms;     // 0: not in the paper's table
    bool black = false;  // shown without light: a picture without edges, which cannot be known ahead
};
constexpr Mode modes[] = {{"none", 0},       {"msaa4", 0},       {"mlaa", 0},
                          {"smaa_1x", 1.02}, {"smaa_t2x", 1.32}, {"smaa_s2x", 2.04},
                          {"smaa_4x", 2.34}, {"none", 0, true},  {"smaa_1x", 0, true}};

struct Subject {
    Mode mode;
    Portrait character;
    ViewFrame view;
    std::vector<double> frame_ms, added_ms;
    std::map<std::string, std::vector<double>, std::less<>> pass_ms;  // sums over the pictures of a frame
};

bool of_the_mode(std::string_view pass) {
    constexpr std::string_view scene[] = {"deform",      "turn normals", "skin",    "blend blood", "velocities",
                                          "shadow maps", "shade",        "scatter", "tone"};
    return std::ranges::find(scene, pass) == std::end(scene);
}

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

void pose(Portrait& character, std::size_t frame) {
    for (std::size_t k = 0; k < 4; ++k) {
        character.controls()[k] = 0.5F + 0.5F * std::sin(0.3F * static_cast<float>(frame) + static_cast<float>(k));
    }
}

void draw(Subject& subject, std::size_t frame) {
    pose(subject.character, frame);
    const auto start = std::chrono::steady_clock::now();
    const FrameReport& report = subject.character.draw(subject.view);
    glFinish();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    subject.frame_ms.push_back(elapsed.count());
    double added = 0;
    std::map<std::string, double, std::less<>> sums;
    for (const PassReport& pass : report.passes) {
        if (of_the_mode(pass.name)) added += pass.milliseconds;
        if (of_the_mode(pass.name) || pass.name == "velocities") sums[std::string(pass.name)] += pass.milliseconds;
    }
    subject.added_ms.push_back(added);
    for (const auto& [name, sum] : sums) subject.pass_ms[name].push_back(sum);
}

/// Beyond one step of 8 bits: means of rounded pictures round otherwise than one picture does.
double error_of(const Image& image, const Image& reference) {
    double sum = 0;
    for (std::size_t i = 0; i < image.bytes.size(); ++i) {
        sum += std::max(0, std::abs(image.bytes[i] - reference.bytes[i]) - 1);
    }
    return sum / static_cast<double>(image.bytes.size());
}

/// Of a still face.
Image still(Portrait& character, ViewFrame view, const Offscreen& offscreen, int frames) {
    pose(character, 0);
    view.timed = false;
    for (int frame = 0; frame < frames; ++frame) character.draw(view);
    return offscreen.read();
}

/// Milliseconds of making a character and drawing its first two frames: all that compiles something.
double new_character_ms(const Device& device, const Face& face, const Offscreen& offscreen) {
    const auto start = std::chrono::steady_clock::now();
    Result<Portrait> character = Portrait::create(device, face);
    if (!character || !character->set("antialiasing.mode", "smaa_4x")) return -1;
    ViewFrame view = offscreen.view();
    view.camera = character->framing(1).camera(1);
    for (std::size_t frame = 0; frame < 2; ++frame) {
        pose(*character, frame);
        character->draw(view);
    }
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void measure_new_characters() {
    const Face face = test::make_face({.side = 14, .targets = 4});
    std::vector<double> first, further;
    for (int round = 0; round < 5; ++round) {
        // A device of its own has compiled nothing yet.
        const Result<Device> device = Device::headless(false);
        if (!device) return;
        const Result<Offscreen> offscreen = Offscreen::create(*device, 32, 32, Output::display_srgb);
        if (!offscreen) return;
        first.push_back(new_character_ms(*device, face, *offscreen));
        further.push_back(new_character_ms(*device, face, *offscreen));
    }
    std::printf(
        "a new character of SMAA 4x and its first two frames, 32x32: %.1f ms where it compiles all programs, %.1f "
        "ms (%.1f-%.1f) where the device has them\n",
        quantile(first, 0.5), quantile(further, 0.5), quantile(further, 0), quantile(further, 1));
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t rounds = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 31;
    const auto side = static_cast<std::uint32_t>(argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 512);
    Result<Device> device = Device::headless(false);
    Result<Offscreen> offscreen =
        device ? Offscreen::create(*device, side, side, Output::display_srgb) : Result<Offscreen>(device.error());
    if (!offscreen || rounds == 0) {
        std::fprintf(stderr, "bench_antialiasing_modes: %s\n",
                     offscreen ? "no rounds" : offscreen.error().message.c_str());
        return 2;
    }
    measure_new_characters();
    Face face = test::make_face({.side = 100, .targets = 4, .normal_deltas = true});
    for (Material& material : face.materials) material.skin = false;  // which the modes add nothing to
    const auto make = [&](const Mode& mode) -> std::optional<Subject> {
        Result<Portrait> character = Portrait::create(*device, face);
        if (!character || !character->set("antialiasing.mode", mode.name)) return std::nullopt;
        Subject subject{mode, *std::move(character), offscreen->view(), {}, {}, {}};
        subject.view.camera = subject.character.framing(1).camera(1);
        if (mode.black) subject.view.exposure = 0;
        subject.view.timed = true;
        return subject;
    };
    std::optional<Subject> reference = make({"supersampled", 0});
    if (!reference || !reference->character.set("supersampling.factor", "8")) return 2;
    const Image truth = still(reference->character, reference->view, *offscreen, 1);

    std::vector<Subject> subjects;
    std::vector<double> errors;
    bool good = true;
    for (const Mode& mode : modes) {
        std::optional<Subject> subject = make(mode);
        if (!subject) return 2;
        errors.push_back(mode.black ? 0 : error_of(still(subject->character, subject->view, *offscreen, 3), truth));
        good &= mode.black || errors.size() == 1 || errors.back() < errors.front();
        subjects.push_back(*std::move(subject));
    }
    for (std::size_t round = 0; round < rounds; ++round) {
        for (Subject& subject : subjects) draw(subject, round);
    }

    const auto one =
        std::ranges::find(subjects, std::string("smaa_1x"), [](const Subject& s) { return std::string(s.mode.name); });
    std::printf("%s, %ux%u, %zu rounds in turn; a face of %zu vertices that moves\n", device->info().renderer.c_str(),
                side, side, rounds, face.positions.size());
    std::printf("%-16s %8s %20s %22s %7s %9s\n", "mode", "frame ms", "mode ms (quartiles)", "x SMAA 1x (quartiles)",
                "paper", "error/255");
    for (std::size_t s = 0; s < subjects.size(); ++s) {
        const Subject& subject = subjects[s];
        std::vector<double> ratios;
        for (std::size_t round = 0; round < rounds; ++round)
            ratios.push_back(subject.added_ms[round] / one->added_ms[round]);
        const double paper = subject.mode.paper_ms / 1.02;
        std::printf("%-10s %-5s %8.2f %7.2f (%.2f-%.2f) %9.2f (%.2f-%.2f)", subject.mode.name,
                    subject.mode.black ? "black" : "", quantile(subject.frame_ms, 0.5), quantile(subject.added_ms, 0.5),
                    quantile(subject.added_ms, 0.25), quantile(subject.added_ms, 0.75), quantile(ratios, 0.5),
                    quantile(ratios, 0.25), quantile(ratios, 0.75));
        if (paper > 0) {
            std::printf(" %7.2f", paper);
        } else {
            std::printf(" %7s", "");
        }
        std::printf(" %9.4f\n", errors[s]);
    }
    std::printf("passes, ms a frame, least of all rounds:\n");
    for (const Subject& subject : subjects) {
        std::printf("  %-9s%-6s", subject.mode.name, subject.mode.black ? " black" : "");
        for (const auto& [name, times] : subject.pass_ms) std::printf("  %s %.2f", name.c_str(), quantile(times, 0));
        std::printf("\n");
    }
    return good ? 0 : 1;
}
