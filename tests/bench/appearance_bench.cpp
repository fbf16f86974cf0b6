/// bench_appearance FACE [ROUNDS [SIDE_PIXELS]]: what wrinkles and blood cost a frame, as frame with minus frame
/// without.
///
/// The face is angry, by a little more or less from frame to frame, so that the blood is blended anew in each; a face
/// at rest is measured too. All four variants run in turn in one process. Exit status 1 where a variant's picture is
/// not what it should be: all the same at rest, all different in anger.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <epoxy/gl.h>

#include "runtime/character.h"
#include "runtime/offscreen.h"

namespace {

using namespace blush;

struct Variant {
    const char* name;
    bool wrinkles, blood;
};
constexpr std::array<Variant, 4> variants = {
    {{"neither", false, false}, {"wrinkles", true, false}, {"blood", false, true}, {"both", true, true}}};

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

double draw_ms(Character& character, const View& view) {
    const auto start = std::chrono::steady_clock::now();
    character.draw(view);
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t rounds = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 31;
    const auto side = static_cast<std::uint32_t>(argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 512);
    if (argc < 2 || rounds == 0) {
        std::fprintf(stderr, "usage: bench_appearance FACE [ROUNDS [SIDE_PIXELS]]\n");
        return 2;
    }
    Result<Device> device = Device::headless(false);
    Result<Offscreen> offscreen =
        device ? Offscreen::create(*device, side, side, Output::display_srgb) : Result<Offscreen>(device.error());
    if (!offscreen) {
        std::fprintf(stderr, "bench_appearance: %s\n", offscreen.error().message.c_str());
        return 2;
    }
    std::vector<Character> characters;
    for (const Variant& variant : variants) {
        Result<Character> character = Character::load(*device, argv[1]);
        Status set = character ? Status(Done{}) : Status(character.error());
        if (set) set = character->set("wrinkles.shown", variant.wrinkles ? "yes" : "no");
        if (set) set = character->set("blood.shown", variant.blood ? "yes" : "no");
        if (!set) {
            std::fprintf(stderr, "bench_appearance: %s\n", set.error().message.c_str());
            return 2;
        }
        characters.push_back(*std::move(character));
    }
    View view = offscreen->view();
    view.camera = characters[0].framing(1).camera(1);

    bool good = true;
    for (const bool rest : {true, false}) {
        std::array<std::vector<double>, variants.size()> frame_ms, added_ms;
        std::array<Image, variants.size()> pictures;
        for (std::size_t round = 0; round < rounds + 1; ++round) {
            double without = 0;
            for (std::size_t v = 0; v < variants.size(); ++v) {
                const float anger = rest ? 0 : 0.9F + 0.01F * static_cast<float>(round % 2);
                characters[v].set(*characters[v].control("anger"), anger);
                const double ms = draw_ms(characters[v], view);
                if (v == 0) without = ms;
                if (round == 0) {  // textures and programs are made in the first
                    pictures[v] = offscreen->read();
                    continue;
                }
                frame_ms[v].push_back(ms);
                added_ms[v].push_back(ms - without);
            }
        }
        std::printf("%s, %u x %u pixels, %zu rounds\n", rest ? "at rest" : "anger", side, side, rounds);
        for (std::size_t v = 0; v < variants.size(); ++v) {
            std::printf("  %-9s frame %7.2f ms; with minus without %+6.2f ms (%+.2f to %+.2f), %+.1f %%\n",
                        variants[v].name, quantile(frame_ms[v], 0.5), quantile(added_ms[v], 0.5),
                        quantile(added_ms[v], 0.25), quantile(added_ms[v], 0.75),
                        100 * quantile(added_ms[v], 0.5) / quantile(frame_ms[0], 0.5));
            const bool same = pictures[v].bytes == pictures[0].bytes;
            if (v > 0 && same != rest) {
                std::fprintf(stderr, "bench_appearance: %s %s\n", variants[v].name,
                             same ? "does not show" : "shows at rest");
                good = false;
            }
        }
    }
    return good ? 0 : 1;
}
