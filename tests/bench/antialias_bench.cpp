// What each pass of MLAA and SMAA costs on the GPU, on a picture with contours and on one without edges. All variants
// run in turn, round by round; medians, and quartiles as the spread. The output of the last round is checked against
// the filters on the CPU.
//   bench_antialias [ROUNDS [SIDE_PIXELS]]

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "rig/antialias/blend.h"
#include "rig/antialias/smaa_tables.h"
#include "runtime/antialias/antialias_passes.h"
#include "runtime/device.h"
#include "runtime/gl/state_guard.h"

namespace blush {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_of(const std::function<void()>& run) {
    const auto start = Clock::now();
    run();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Circles of many sizes: contours of every direction, about as many as a rendered frame has.
Pixels circles(int side) {
    Pixels picture(side, side, {0.2F, 0.2F, 0.25F, 1});
    const float cell = static_cast<float>(side) / 4;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const float column = std::floor(static_cast<float>(x) / cell),
                        row = std::floor(static_cast<float>(y) / cell);
            const float dx = static_cast<float>(x) - (column + 0.5F) * cell,
                        dy = static_cast<float>(y) - (row + 0.5F) * cell;
            if (std::hypot(dx, dy) < cell * (0.15F + 0.02F * (column + 4 * row)))
                picture.at(x, y) = {0.9F, 0.7F, 0.6F, 1};
        }
    }
    return picture;
}

struct Target {
    Target(int side, GLenum format)
        : side_pixels(static_cast<std::uint32_t>(side)),
          texture(gl::make_texture(GL_TEXTURE_2D)),
          framebuffer(gl::make_framebuffer()) {
        glTextureStorage2D(texture.name(), 1, format, side, side);
        glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
    }
    PassTarget pass() const { return {framebuffer.name(), side_pixels, side_pixels}; }
    std::uint32_t side_pixels;
    gl::Texture texture;
    gl::Framebuffer framebuffer;
};

struct Variant {
    std::string name;
    std::function<void()> run;
    std::vector<double> milliseconds = {};
};

int run(int rounds, int side) {
    Result<Device> device = Device::headless(false);
    if (!device) return std::fprintf(stderr, "%s\n", device.error().message.c_str()), 1;
    std::printf("%s, %dx%d pixels, %d rounds\n", device->info().renderer.c_str(), side, side, rounds);
    std::printf("area and search tables: %.1f ms\n", milliseconds_of([] { smaa_areas(), search_table(); }));
    Result<AntialiasPasses> passes = AntialiasPasses::create();
    if (!passes) return std::fprintf(stderr, "%s\n", passes.error().message.c_str()), 1;

    const gl::StateGuard guard;
    const PictureMeaning meaning;
    EdgeTiles tiles;
    const Target edges(side, GL_RG8), weights(side, GL_RGBA8), out(side, GL_RGBA8);
    std::vector<Pixels> pictures = {Pixels(side, side, {0.5F, 0.4F, 0.3F, 1}), circles(side)};
    std::vector<Target> colors;
    std::vector<Variant> variants;
    for (std::size_t p = 0; p < pictures.size(); ++p) {
        const Target& color = colors.emplace_back(side, GL_RGBA8);
        glTextureSubImage2D(color.texture.name(), 0, 0, 0, side, side, GL_RGBA, GL_FLOAT, pictures[p].cells.data());
    }
    for (std::size_t p = 0; p < pictures.size(); ++p) {
        const std::string picture = p == 0 ? "no edges" : "circles";
        const GLuint color = colors[p].texture.name();
        const auto find = [&, color](const EdgeSettings& settings) {
            passes->edges(color, 0, settings, meaning, tiles, edges.pass());
        };
        const auto blend = [&, color] { passes->blend(color, weights.texture.name(), meaning, tiles, out.pass()); };
        variants.push_back({picture + ": copy", [&, p] {
                                glBlitNamedFramebuffer(colors[p].framebuffer.name(), out.framebuffer.name(), 0, 0, side,
                                                       side, 0, 0, side, side, GL_COLOR_BUFFER_BIT, GL_NEAREST);
                            }});
        variants.push_back({picture + ": edges", [=] { find(smaa_preset(SmaaPreset::high).edges); }});
        variants.push_back({picture + ": MLAA", [&, find, blend] {
                                find(MlaaSettings().edges);
                                passes->mlaa_weights(edges.texture.name(), {}, tiles, weights.pass());
                                blend();
                            }});
        for (std::size_t preset = 0; preset < smaa_preset_names.size(); ++preset) {
            const SmaaSettings settings = smaa_preset(static_cast<SmaaPreset>(preset));
            const std::string name = picture + ": SMAA 1x " + std::string(smaa_preset_names[preset]);
            variants.push_back({name + ", edges and weights", [&, settings, find] {
                                    find(settings.edges);
                                    passes->smaa_weights(edges.texture.name(), settings, SubsampleSlices(0), tiles,
                                                         weights.pass());
                                }});
            variants.push_back({name, [&, settings, find, blend] {
                                    find(settings.edges);
                                    passes->smaa_weights(edges.texture.name(), settings, SubsampleSlices(0), tiles,
                                                         weights.pass());
                                    blend();
                                }});
        }
    }
    for (int round = -1; round < rounds; ++round) {  // the first compiles the shaders
        for (Variant& variant : variants) {
            glFinish();
            const double spent = milliseconds_of([&] { variant.run(), glFinish(); });
            if (round >= 0) variant.milliseconds.push_back(spent);
        }
    }
    for (Variant& variant : variants) {
        std::ranges::sort(variant.milliseconds);
        const auto quantile = [&](double share) {
            return variant
                .milliseconds[static_cast<std::size_t>(share * static_cast<double>(variant.milliseconds.size() - 1))];
        };
        std::printf("%-44s %8.3f ms (%.3f to %.3f)\n", variant.name.c_str(), quantile(0.5), quantile(0.25),
                    quantile(0.75));
    }
    return 0;
}

}  // namespace
}  // namespace blush

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 21;
    const int side = argc > 2 ? std::clamp(std::atoi(argv[2]), 8, 4096) : 512;
    return blush::run(rounds, side);
}
