/// bench_deformation [ROUNDS]: what a frame's deformation costs with 52 of 8,192 targets active, against a face of the
/// same size that has just those 52; and against the paper's scheme of repeated passes. All variants run in turn in one
/// process, with weights that change every frame. The outputs are compared bit for bit first; exit status 1 if they
/// differ.
///
/// The bar: the ratio's median is at most 1.10.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "runtime/frame/frame.h"
#include "runtime/frame/frame_state.h"
#include "runtime/measure/portrait.h"

namespace {

using namespace blush;

constexpr std::uint32_t columns = 163, rows = 164;  // 26,732 vertices: the size of the ICT head (26,719)
constexpr std::uint32_t active_count = 52;

Face grid() {
    Face face;
    face.path = "grid";
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            face.positions.emplace_back(static_cast<float>(x) * 0.001F, static_cast<float>(y) * 0.001F, 0.0F);
        }
    }
    const std::size_t count = face.positions.size();
    face.normals.assign(count, glm::vec3(0, 0, 1));
    face.tangents.assign(count, glm::vec4(1, 0, 0, 1));
    face.uv0.assign(count, glm::vec2(0));
    face.uv1.assign(count, glm::vec2(0));
    for (std::uint32_t y = 0; y + 1 < rows; ++y) {
        for (std::uint32_t x = 0; x + 1 < columns; ++x) {
            const std::uint32_t a = y * columns + x, b = a + 1, c = a + columns, d = c + 1;
            face.indices.insert(face.indices.end(), {a, b, d, a, d, c});
        }
    }
    Primitive primitive;
    primitive.vertex_count = static_cast<std::uint32_t>(count);
    primitive.index_count = static_cast<std::uint32_t>(face.indices.size());
    primitive.normal_source = NormalSource::authored;
    primitive.authored_normals = true;
    face.primitives = {primitive};
    face.meshes = {{"grid", 0, 1}};
    Node node;
    node.mesh = 0;
    face.nodes = {node};
    return face;
}

/// A target that moves `moved` vertices in a row, as facial targets do: a region.
Target region(std::mt19937& random, std::size_t vertices, std::uint32_t moved, const std::string& name) {
    Target target;
    target.name = name;
    const auto first = static_cast<std::uint32_t>(random() % (vertices - moved));
    const auto unit = [&] { return static_cast<float>(random() % 2001) * 1e-6F - 1e-3F; };
    for (std::uint32_t v = 0; v < moved; ++v) {
        target.vertices.push_back(first + v);
        target.position_deltas.emplace_back(unit(), unit(), unit());
        target.normal_deltas.emplace_back(unit(), unit(), unit());
    }
    return target;
}

struct Subject {
    std::string name;
    Portrait character;
    std::vector<std::uint32_t> active;

    void set_weights(std::uint32_t frame) {
        for (std::uint32_t k = 0; k < active.size(); ++k) {
            character.controls()[active[k]] = 0.2F + 0.01F * static_cast<float>((frame * 7 + k * 13) % 60);
        }
    }
    double frame_ms(std::uint32_t frame) {
        const auto start = std::chrono::steady_clock::now();
        set_weights(frame);
        deform_only(character.frame(), character.scene().state());
        glFinish();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
};

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t rounds = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 101;
    if (rounds == 0) {
        std::fputs("usage: bench_deformation [ROUNDS]\n", stderr);
        return 2;
    }
    std::mt19937 random(1);  // a fixed seed: the same faces on every machine
    Face few = grid();
    for (std::uint32_t t = 0; t < active_count; ++t) {
        few.targets.push_back(region(random, few.positions.size(), 4000, "shape" + std::to_string(t)));
    }
    // The same 52 shapes, spread evenly among 8,140 others.
    constexpr std::uint32_t many_count = 8192, spacing = many_count / active_count;
    Face many = grid();
    for (std::uint32_t t = 0; t < many_count; ++t) {
        const bool shared = t % spacing == 0 && t / spacing < active_count;
        many.targets.push_back(shared ? few.targets[t / spacing]
                                      : region(random, many.positions.size(), 400, "other" + std::to_string(t)));
    }

    Result<Device> device = Device::headless(false);
    if (!device) {
        std::fprintf(stderr, "bench_deformation: %s\n", device.error().message.c_str());
        return 2;
    }
    std::vector<Subject> subjects;
    const auto add = [&](const std::string& name, const Face& face, std::uint32_t step) {
        Result<Portrait> character = Portrait::create(*device, face);
        if (!character) return false;
        std::vector<std::uint32_t> active;
        for (std::uint32_t k = 0; k < active_count; ++k) active.push_back(k * step);
        subjects.push_back({name, *std::move(character), std::move(active)});
        return true;
    };
    if (!add("52 of 52 targets", few, 1) || !add("52 of 8192 targets", many, spacing) ||
        !add("52 of 52 targets, in passes of four", few, 1)) {
        std::fputs("bench_deformation: a face does not fit this device\n", stderr);
        return 2;
    }
    if (Status chosen = subjects[2].character.set("deformation.method", "passes"); !chosen) return 2;

    const auto positions = [](Subject& subject) {
        subject.set_weights(0);
        return subject.character.read_deformed().positions;
    };
    const std::vector<glm::vec3> expected = positions(subjects[0]);
    for (std::size_t s = 1; s < subjects.size(); ++s) {
        if (positions(subjects[s]) != expected || expected == few.positions) {
            std::fprintf(stderr, "bench_deformation: \"%s\" gives another surface\n", subjects[s].name.c_str());
            return 1;
        }
    }

    std::vector<std::vector<double>> times(subjects.size());
    for (std::size_t round = 0; round < rounds; ++round) {
        for (std::size_t s = 0; s < subjects.size(); ++s) {
            times[s].push_back(subjects[s].frame_ms(static_cast<std::uint32_t>(round + 1)));
        }
    }
    std::printf("%s, %zu vertices, %zu rounds in turn\n", device->info().renderer.c_str(), few.positions.size(),
                rounds);
    for (std::size_t s = 0; s < subjects.size(); ++s) {
        std::vector<double> ratios;
        for (std::size_t round = 0; round < rounds; ++round) ratios.push_back(times[s][round] / times[0][round]);
        std::printf("%-38s %7.3f ms (%.3f to %.3f)   x%.3f (%.3f to %.3f) of \"%s\"\n", subjects[s].name.c_str(),
                    quantile(times[s], 0.5), quantile(times[s], 0.25), quantile(times[s], 0.75), quantile(ratios, 0.5),
                    quantile(ratios, 0.25), quantile(ratios, 0.75), subjects[0].name.c_str());
    }
    return 0;
}
