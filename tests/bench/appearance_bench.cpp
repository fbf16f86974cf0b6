/// bench_appearance FACE [ROUNDS [SIDE_PIXELS [portrait]]]: what wrinkles and blood cost a frame, as frame with minus
/// frame without.
///
/// The frame is filled by the face's skin alone, one sample a pixel, without shadows and scattering: what is measured
/// is not diluted; `portrait` draws the whole face with the defaults instead. One character draws all frames, and each
/// frame with an effect stands between two without: a difference is of neighbours, so that a slow change of the machine
/// falls out. The pose is a little different in each frame, so that blood is blended anew. Two clocks: the processor
/// time of the process (all of its threads; other processes do not count), which for a software rasteriser is the work,
/// and the GL's own time stamps around the shading pass. On a GPU the second is the one to read.
///
/// Medians, with quartiles of the differences and the 95 % interval of their median. "rest": all weights are zero, and
/// what is measured is what effects cost that do not act. Exit status 1 where a picture is not what it should be: the
/// same bits at rest, others in anger.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string_view>
#include <vector>

#include <epoxy/gl.h>

#include "rig/head/canonical_face.h"
#include "runtime/files/face_file.h"
#include "runtime/measure/portrait.h"
#include "runtime/offscreen.h"

namespace {

using namespace blush;

struct Variant {
    const char* name;
    bool wrinkles, blood;
    const char* storage = "compressed";
};
constexpr std::array<Variant, 4> variants = {{{"wrinkles", true, false},
                                              {"wrinkles, not compressed", true, false, "plain"},
                                              {"blood", false, true},
                                              {"both", true, true}}};

struct Times {
    double frame_ms = 0, shade_ms = 0;
};

struct Pictures {
    Portrait character;
    ViewFrame view;
    const Offscreen& offscreen;
    bool rest;
    std::size_t frames = 0;

    void show(bool wrinkles, bool blood) {
        (void)character.set("wrinkles.shown", wrinkles ? "yes" : "no");
        (void)character.set("blood.shown", blood ? "yes" : "no");
    }
    Times draw() {
        // Three poses in turn: neither frames with nor frames without keep to some of them.
        if (!rest) character.set(*character.control("anger"), 0.9F + 0.01F * static_cast<float>(frames++ % 3));
        const double start = processor_ms();
        const FrameReport& report = character.draw(view);
        glFinish();
        Times times{processor_ms() - start, 0};
        for (const PassReport& pass : report.passes)
            if (pass.name == "shade") times.shade_ms = pass.milliseconds;
        return times;
    }
    static double processor_ms() {
        timespec now{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
        return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
    }
};

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(values.size() - 1);
    return values[static_cast<std::size_t>(place + 0.5)];
}

void print(const char* what, const std::vector<double>& without, const std::vector<double>& added) {
    const double base = quantile(without, 0.5), median = quantile(added, 0.5);
    // The order statistics that hold the median in 95 of 100 samples (normal approximation of the binomial).
    const double reach = 0.98 / std::sqrt(static_cast<double>(added.size()));
    std::printf(
        "    %s %8.3f ms; with minus without %+7.3f ms (quartiles %+.3f, %+.3f; median within %+.3f, %+.3f): "
        "%+.2f %% (%+.2f to %+.2f)\n",
        what, base, median, quantile(added, 0.25), quantile(added, 0.75), quantile(added, 0.5 - reach),
        quantile(added, 0.5 + reach), 100 * median / base, 100 * quantile(added, 0.5 - reach) / base,
        100 * quantile(added, 0.5 + reach) / base);
}

bool measure(Pictures& scene, const Variant& variant, std::size_t rounds) {
    (void)scene.character.set("wrinkles.storage", variant.storage);
    const auto without = [&] {
        scene.show(false, false);
        return scene.draw();
    };
    const auto with = [&] {
        scene.show(variant.wrinkles, variant.blood);
        return scene.draw();
    };
    // Programs and textures are made in the first frames; pictures of the same pose are compared.
    scene.frames = 0;
    (void)without();
    const Image plain = scene.offscreen.read();
    scene.frames = 0;
    (void)with();
    const Image changed = scene.offscreen.read();

    std::array<std::vector<double>, 2> base, added;
    Times before = without();
    for (std::size_t round = 0; round < rounds; ++round) {
        const Times here = with(), after = without();
        base[0].push_back(after.frame_ms);
        base[1].push_back(after.shade_ms);
        added[0].push_back(here.frame_ms - (before.frame_ms + after.frame_ms) / 2);
        added[1].push_back(here.shade_ms - (before.shade_ms + after.shade_ms) / 2);
        before = after;
    }
    std::printf("  %s\n", variant.name);
    print("frame, processor time", base[0], added[0]);
    print("shading pass, GL time", base[1], added[1]);
    if ((changed.bytes == plain.bytes) == scene.rest) return true;
    std::fprintf(stderr, "bench_appearance: %s %s\n", variant.name, scene.rest ? "shows at rest" : "does not show");
    return false;
}

/// Draws skin alone: the other primitives lose their triangles.
void keep_skin(Face& face) {
    const std::vector<std::uint32_t> skin = skin_primitives(face);
    for (std::uint32_t p = 0; p < face.primitives.size(); ++p)
        if (std::ranges::find(skin, p) == skin.end()) face.primitives[p].index_count = 0;
}

Result<Portrait> load(const Device& device, const char* path, bool portrait) {
    Result<Face> face = load_face(path);
    if (!face) return face.error();
    Result<FaceAppearance> appearance = load_face_appearance(appearance_folder(path));
    if (!appearance) return appearance.error();
    if (!portrait) keep_skin(*face);
    Result<Portrait> character = Portrait::create(device, *std::move(face));
    if (!character) return character;
    character->set_appearance(*std::move(appearance));
    constexpr std::array<std::pair<const char*, const char*>, 4> alone = {{{"antialiasing.mode", "none"},
                                                                           {"scattering.method", "off"},
                                                                           {"shadows.method", "off"},
                                                                           {"translucency.strength", "0"}}};
    for (const auto& [setting, value] : alone) {
        if (portrait) break;
        if (const Status set = character->set(setting, value); !set) return set.error();
    }
    return character;
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t rounds = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 101;
    const auto side = static_cast<std::uint32_t>(argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 256);
    const bool portrait = argc > 4 && std::string_view(argv[4]) == "portrait";
    if (argc < 2 || argc > 5 || rounds == 0 || side == 0 || (argc > 4 && !portrait)) {
        std::fprintf(stderr, "usage: bench_appearance FACE [ROUNDS [SIDE_PIXELS [portrait]]]\n");
        return 2;
    }
    const Result<Device> device = Device::headless(false);
    const Result<Offscreen> offscreen =
        device ? Offscreen::create(*device, side, side, Output::display_srgb) : Result<Offscreen>(device.error());
    Result<Portrait> character = offscreen ? load(*device, argv[1], portrait) : Result<Portrait>(offscreen.error());
    if (!character) {
        std::fprintf(stderr, "bench_appearance: %s\n", character.error().message.c_str());
        return 2;
    }
    ViewFrame view = offscreen->view();
    view.timed = true;
    OrbitCamera camera = character->framing(1);
    if (!portrait) camera.distance *= 0.4F;
    view.camera = camera.camera(1);
    Pictures scene{*std::move(character), view, *offscreen, false};

    bool good = true;
    for (const bool rest : {false, true}) {
        scene.rest = rest;
        scene.character.set(*scene.character.control("anger"), rest ? 0 : 0.9F);
        std::printf("%s, %u x %u pixels%s, %zu rounds\n", rest ? "rest" : "anger", side, side,
                    portrait ? ", the whole face with the defaults" : " of skin alone", rounds);
        for (const Variant& variant : variants) good = measure(scene, variant, rounds) && good;
    }
    return good ? 0 : 1;
}
