/// bench_vertex [--quick] [GOOGLE BENCHMARK'S OPTIONS]: the CPU's vertex path against a plain dense loop over all
/// targets, Eigen's sparse product, and a copy of as many bytes as must be read; and how its cost grows with vertices,
/// targets, active targets and faces. Positions; the last family adds normals and tangents.
///
/// Every round runs all of them in turn, so that a change of the machine's speed meets all alike; the table gives the
/// median of each ratio over the rounds, and its quartiles. Outputs are compared before anything is timed; exit status
/// 1 if they differ. --quick: few rounds on small faces, for that comparison alone.
///
/// The bars, on the ICT head with 10 of 57 targets active: 5 times as fast as the dense loop, and 70 % of the speed of
/// a copy. What must be read: the rest positions and the deltas of the active targets, 12 bytes each.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

// Eigen's and Google Benchmark's headers do not hold our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <benchmark/benchmark.h>

#include <Eigen/SparseCore>
#pragma GCC diagnostic pop

#include "rig/deform/deform.h"
#include "tests/bench/ict_head.h"
#include "tests/shared_data.h"
#include "tests/test_faces.h"

namespace {

using namespace blush;
using test::Random;

bool quick = false;
bool all_equal = true;

// --- faces ----------------------------------------------------------------------------------------------------------

struct Shape {
    std::uint32_t vertices = 0, targets = 0, moved = 0;  ///< moved: vertices that each target moves, about
    bool normals = false;
};

/// Targets as those of a head are: each a region, in rows of 1 to 12 vertices with 1 to 8 between them. The ICT head's
/// 57 targets have rows of 6.2 vertices on average.
Face synthetic(const Shape& shape) {
    Face face;
    face.path = "synthetic";
    Random random(shape.vertices + shape.targets);
    for (std::uint32_t v = 0; v < shape.vertices; ++v) {
        face.positions.emplace_back(random.between(-0.1F, 0.1F), random.between(-0.1F, 0.1F),
                                    random.between(-0.1F, 0.1F));
    }
    face.normals.assign(shape.vertices, glm::vec3(0.36F, 0.48F, 0.8F));
    face.tangents.assign(shape.vertices, glm::vec4(0.8F, -0.6F, 0, 1));
    face.uv0.assign(shape.vertices, glm::vec2(0));
    face.uv1 = face.uv0;
    Primitive primitive;
    primitive.vertex_count = shape.vertices;
    primitive.normal_source = shape.normals ? NormalSource::authored : NormalSource::rest;
    face.primitives = {primitive};
    constexpr std::uint32_t row = 12, gap = 8;
    for (std::uint32_t t = 0; t < shape.targets; ++t) {
        Target target;
        // Rows of 6.5 and gaps of 4.5 on average.
        const std::uint32_t reach = std::min(shape.vertices - 1, shape.moved * 11 / 6);
        std::uint32_t v = static_cast<std::uint32_t>(random.bits() % (shape.vertices - reach));
        while (target.vertices.size() < shape.moved && v < shape.vertices) {
            for (std::uint64_t left = 1 + random.bits() % row; left > 0 && v < shape.vertices; --left, ++v) {
                target.vertices.push_back(v);
                const auto delta = [&] {
                    return glm::vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)) * 0.01F;
                };
                target.position_deltas.push_back(delta());
                if (shape.normals) target.normal_deltas.push_back(delta());
            }
            v += 1 + static_cast<std::uint32_t>(random.bits() % gap);
        }
        face.targets.push_back(std::move(target));
    }
    return face;
}

// --- what is measured ------------------------------------------------------------------------------------------------

double seconds(const std::function<void()>& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Quartiles {
    double low = 0, median = 0, high = 0;
};

Quartiles quartiles(std::vector<double> values) {
    std::ranges::sort(values);
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
    };
    return {at(0.25), at(0.5), at(0.75)};
}

/// One way to the same result. `run` is repeated in a round until it has taken long enough to be timed.
struct Contender {
    std::string name;
    std::function<void()> run;
    std::size_t repeats = 1;
    std::vector<double> times = {};  ///< seconds a run, one a round
};

struct Row {
    std::string name;
    double megabytes = 0;
    Quartiles microseconds;
    std::vector<std::pair<std::string, Quartiles>> against;
};
std::vector<Row> rows;

/// Positions of all targets as one dense array each.
std::vector<std::vector<float>> dense_targets(const Face& face) {
    std::vector<std::vector<float>> dense;
    for (const Target& target : face.targets) {
        dense.emplace_back(face.positions.size() * 3, 0.0F);
        for (std::size_t i = 0; i < target.vertices.size(); ++i) {
            std::memcpy(&dense.back()[target.vertices[i] * std::size_t{3}], &target.position_deltas[i],
                        sizeof(glm::vec3));
        }
    }
    return dense;
}

Eigen::SparseMatrix<float> sparse_matrix(const Face& face) {
    Eigen::SparseMatrix<float> matrix(static_cast<Eigen::Index>(face.positions.size() * 3),
                                      static_cast<Eigen::Index>(face.targets.size()));
    Eigen::VectorXi sizes(static_cast<Eigen::Index>(face.targets.size()));
    for (std::size_t t = 0; t < face.targets.size(); ++t) {
        sizes[static_cast<Eigen::Index>(t)] = static_cast<int>(face.targets[t].vertices.size() * 3);
    }
    matrix.reserve(sizes);
    for (std::size_t t = 0; t < face.targets.size(); ++t) {
        const Target& target = face.targets[t];
        for (std::size_t i = 0; i < target.vertices.size(); ++i) {
            for (glm::length_t c = 0; c < 3; ++c) {
                matrix.insert(static_cast<Eigen::Index>(target.vertices[i]) * 3 + c, static_cast<Eigen::Index>(t)) =
                    target.position_deltas[i][c];
            }
        }
    }
    matrix.makeCompressed();
    return matrix;
}

/// `count` weights that are not zero, spread over the targets.
std::vector<float> weights_of(const Face& face, std::size_t count, std::size_t seed) {
    std::vector<float> weights(face.targets.size(), 0);
    const std::size_t targets = weights.size();
    for (std::size_t k = 0; k < std::min(count, targets); ++k) {
        weights[(k * targets / count + seed) % targets] = 0.2F + 0.01F * static_cast<float>((k * 13 + seed * 7) % 60);
    }
    return weights;
}

/// A crowd of faces that share one face's targets.
struct Crowd {
    const Face& face;
    const VertexPath& path;
    std::vector<std::vector<float>> weights;
    std::vector<ActivePieces> active;
    std::vector<DeformedSurface> surfaces;
    std::vector<VertexPath::Job> jobs;

    Crowd(const Face& of, const VertexPath& by, std::size_t faces, std::size_t active_count, bool directions = false)
        : face(of), path(by), active(faces), surfaces(faces, {of.positions, of.normals, of.tangents}) {
        for (std::size_t f = 0; f < faces; ++f) {
            weights.push_back(weights_of(face, active_count, f));
            DeformedSurface& out = surfaces[f];
            jobs.push_back({&active[f], NormalMethod::authored, out.positions, {}, {}});
            if (directions) jobs.back().normals = out.normals, jobs.back().tangents = out.tangents;
        }
    }
    void run() { run({&path, 1}, 1); }
    /// All of a frame: lists of the active targets, then the sum.
    void run(std::span<const VertexPath> paths, std::size_t threads) {
        for (std::size_t f = 0; f < jobs.size(); ++f) active[f].build(paths[0].targets(), weights[f]);
        const std::uint32_t count = paths[0].targets().vertex_count;
        std::vector<std::jthread> others;
        for (std::uint32_t k = 1; k < threads; ++k) {
            const VertexRange part{static_cast<std::uint32_t>(std::uint64_t{count} * k / threads),
                                   static_cast<std::uint32_t>(std::uint64_t{count} * (k + 1) / threads)};
            others.emplace_back([&, part] { paths[0].add_targets(jobs, part); });
        }
        paths[0].add_targets(jobs, {0, static_cast<std::uint32_t>(count / threads)});
    }
};

void check(const std::string& what, std::span<const glm::vec3> found, std::span<const glm::vec3> expected) {
    if (std::ranges::equal(found, expected)) return;
    std::fprintf(stderr, "bench_vertex: %s gives other positions\n", what.c_str());
    all_equal = false;
}

/// Rounds of all contenders in turn; the first one is "ours".
void measure(benchmark::State& state, const std::string& name, std::vector<Contender>& contenders, double bytes) {
    // Long enough for the clock, and for the caches to hold what they can of each contender's own data.
    const double enough_seconds = quick ? 0 : 300e-6;
    for (Contender& contender : contenders) {
        const double once = std::min(seconds(contender.run), seconds(contender.run));
        contender.repeats = 1 + static_cast<std::size_t>(enough_seconds / std::max(once, 1e-7));
    }
    for (auto _ : state) {
        for (Contender& contender : contenders) {
            // The others have emptied the caches: one run fills them, a few more settle what stays.
            for (std::size_t k = 0; k < std::min<std::size_t>(contender.repeats, 4); ++k) contender.run();
            const double time = seconds([&] {
                for (std::size_t k = 0; k < contender.repeats; ++k) contender.run();
            });
            contender.times.push_back(time / static_cast<double>(contender.repeats));
        }
        state.SetIterationTime(contenders[0].times.back());
    }
    Row row{name, bytes * 1e-6, {}, {}};
    std::vector<double> ours = contenders[0].times;
    for (double& time : ours) time *= 1e6;
    row.microseconds = quartiles(ours);
    state.counters["us"] = row.microseconds.median;
    for (std::size_t c = 1; c < contenders.size(); ++c) {
        std::vector<double> ratios;
        for (std::size_t r = 0; r < ours.size(); ++r) {
            ratios.push_back(contenders[c].times[r] / contenders[0].times[r]);
        }
        row.against.emplace_back(contenders[c].name, quartiles(ratios));
        state.counters[contenders[c].name] = row.against.back().second.median;
    }
    rows.push_back(std::move(row));
}

/// Positions of one face by every contender.
void positions(benchmark::State& state, const std::string& name, const Face& face, std::size_t active_count) {
    const std::vector<float> weights = weights_of(face, active_count, 0);
    const std::size_t floats = face.positions.size() * 3;
    std::vector<ActiveTarget> active;
    find_active(weights, active);
    double bytes = static_cast<double>(floats * sizeof(float));
    for (const ActiveTarget& entry : active) {
        for (const glm::vec3 delta : face.targets[entry.target].position_deltas) {
            bytes += delta == glm::vec3(0) ? 0.0 : 12.0;
        }
    }

    const NormalTopology topology(face);
    const std::vector<glm::vec3> expected = deform_plain(face, topology, weights, NormalMethod::authored).positions;
    std::vector<Contender> contenders;

    std::vector<std::unique_ptr<VertexPath>> paths;
    std::vector<std::unique_ptr<Crowd>> crowds;
    const auto add_path = [&](const std::string& label, const PackOptions& options, SimdPath simd) {
        paths.push_back(std::make_unique<VertexPath>(face, options, simd));
        crowds.push_back(std::make_unique<Crowd>(face, *paths.back(), 1, active_count));
        Crowd& crowd = *crowds.back();
        crowd.run();
        if (options.precision == DeltaPrecision::exact)
            check(name + ", " + label, crowd.surfaces[0].positions, expected);
        contenders.push_back({label, [&crowd] { crowd.run(); }});
    };
    add_path("ours", {}, simd_paths().back());

    // The copy stands next to ours, so that it finds the machine as ours did.
    std::vector<std::byte> source(static_cast<std::size_t>(bytes), std::byte{1}), destination(source.size());
    contenders.push_back({"copy", [&] {
                              std::memcpy(destination.data(), source.data(), source.size());
                              benchmark::DoNotOptimize(destination.data());
                              benchmark::ClobberMemory();
                          }});
    for (const SimdPath simd : simd_paths().first(simd_paths().size() - 1)) {
        add_path(std::string(name_of(simd)), {}, simd);
    }
    add_path("16-bit", {.precision = DeltaPrecision::sixteen_bits}, simd_paths().back());

    // What the dense and Eigen's contenders may take of a machine's memory.
    constexpr double most_dense_bytes = 800e6, most_sparse_entries = 100e6;
    std::vector<std::vector<float>> dense;
    std::vector<float> out(floats);
    const auto out_positions = [&] {
        std::vector<glm::vec3> result(face.positions.size());
        std::memcpy(result.data(), out.data(), floats * sizeof(float));
        return result;
    };
    if (static_cast<double>(face.targets.size() * floats * sizeof(float)) <= most_dense_bytes) {
        dense = dense_targets(face);
        contenders.push_back({"dense", [&] {
                                  std::memcpy(out.data(), face.positions.data(), floats * sizeof(float));
                                  for (std::size_t t = 0; t < dense.size(); ++t) {
                                      const float weight = weights[t];
                                      const float* deltas = dense[t].data();
                                      for (std::size_t i = 0; i < floats; ++i) out[i] += weight * deltas[i];
                                  }
                                  benchmark::DoNotOptimize(out.data());
                                  benchmark::ClobberMemory();
                              }});
        contenders.back().run();
        check(name + ", dense", out_positions(), expected);
    }
    Eigen::SparseMatrix<float> matrix;
    double entries = 0;
    for (const Target& target : face.targets) entries += static_cast<double>(target.vertices.size() * 3);
    if (entries <= most_sparse_entries) {
        matrix = sparse_matrix(face);
        contenders.push_back({"Eigen", [&] {
                                  const Eigen::Map<const Eigen::VectorXf> w(weights.data(), matrix.cols());
                                  Eigen::Map<Eigen::VectorXf> sum(out.data(), matrix.rows());
                                  std::memcpy(out.data(), face.positions.data(), floats * sizeof(float));
                                  sum.noalias() += matrix * w;
                                  benchmark::DoNotOptimize(out.data());
                                  benchmark::ClobberMemory();
                              }});
        contenders.back().run();
        check(name + ", Eigen", out_positions(), expected);
        // Eigen told which columns are active: the same work as ours, with an index for each float.
        contenders.push_back({"Eigen, active", [&] {
                                  Eigen::Map<Eigen::VectorXf> sum(out.data(), matrix.rows());
                                  std::memcpy(out.data(), face.positions.data(), floats * sizeof(float));
                                  for (const ActiveTarget& entry : active) {
                                      sum += entry.weight * matrix.col(static_cast<Eigen::Index>(entry.target));
                                  }
                                  benchmark::DoNotOptimize(out.data());
                                  benchmark::ClobberMemory();
                              }});
        contenders.back().run();
        check(name + ", Eigen active", out_positions(), expected);
    }
    measure(state, name, contenders, bytes);
}

/// Positions of a crowd: in one batch, face by face, and on two threads.
void crowd(benchmark::State& state, const std::string& name, const Face& face, std::size_t faces,
           std::size_t active_count) {
    const VertexPath path(face);
    const NormalTopology topology(face);
    Crowd batch(face, path, faces, active_count), single(face, path, faces, active_count),
        shared(face, path, faces, active_count);
    const auto one_by_one = [&] {
        for (std::size_t f = 0; f < faces; ++f) {
            single.active[f].build(path.targets(), single.weights[f]);
            path.add_targets({&single.jobs[f], 1}, path.all_vertices());
        }
    };
    batch.run(), one_by_one(), shared.run({&path, 1}, 2);
    double bytes = 0;
    for (std::size_t f = 0; f < faces; ++f) {
        const std::vector<glm::vec3> expected =
            deform_plain(face, topology, batch.weights[f], NormalMethod::authored).positions;
        check(name + ", batch", batch.surfaces[f].positions, expected);
        check(name + ", one by one", single.surfaces[f].positions, expected);
        check(name + ", two threads", shared.surfaces[f].positions, expected);
        bytes += 12.0 * static_cast<double>(face.positions.size());
        for (const ActiveTarget& entry : batch.active[f].targets) {
            bytes += 12.0 * static_cast<double>(face.targets[entry.target].vertices.size());
        }
    }
    std::vector<Contender> contenders = {
        {"batch", [&] { batch.run(); }}, {"one by one", one_by_one}, {"two threads", [&] {
                                                                          shared.run({&path, 1}, 2);
                                                                      }}};
    measure(state, name, contenders, bytes);
}

/// Positions, normals and tangents, finished, against the plain loops.
void directions(benchmark::State& state, const std::string& name, const Face& face, std::size_t active_count) {
    const std::vector<float> weights = weights_of(face, active_count, 0);
    const NormalTopology topology(face);
    const DeformedSurface expected = deform_plain(face, topology, weights, NormalMethod::authored);
    std::vector<Contender> contenders;
    std::vector<std::unique_ptr<VertexPath>> paths;
    std::vector<std::unique_ptr<Crowd>> crowds;
    for (std::size_t p = simd_paths().size(); p-- > 0;) {
        paths.push_back(std::make_unique<VertexPath>(face, PackOptions{}, simd_paths()[p]));
        crowds.push_back(std::make_unique<Crowd>(face, *paths.back(), 1, active_count, true));
        Crowd& one = *crowds.back();
        one.run();
        check(name, one.surfaces[0].positions, expected.positions);
        check(name + " (normals)", one.surfaces[0].normals, expected.normals);
        contenders.push_back({std::string(name_of(simd_paths()[p])), [&one] { one.run(); }});
    }
    contenders.push_back({"plain loops", [&] {
                              DeformedSurface out = deform_plain(face, topology, weights, NormalMethod::authored);
                              benchmark::DoNotOptimize(out.positions.data());
                          }});
    double bytes = 12.0 * 2 * static_cast<double>(face.positions.size());
    for (std::size_t t = 0; t < weights.size(); ++t) {
        if (weights[t] != 0) bytes += 24.0 * static_cast<double>(face.targets[t].vertices.size());
    }
    measure(state, name, contenders, bytes);
}

void print_rows() {
    if (rows.empty()) return;
    std::printf("\nours: time of a frame, median and quartiles. Others: their time / ours. read: what must be read.\n");
    for (const Row& row : rows) {
        std::printf("%-52s read %8.3f MB  %9.1f us (%.1f to %.1f)", row.name.c_str(), row.megabytes,
                    row.microseconds.median, row.microseconds.low, row.microseconds.high);
        for (const auto& [name, ratio] : row.against) {
            std::printf("  %s x%.2f (%.2f to %.2f)", name.c_str(), ratio.median, ratio.low, ratio.high);
        }
        std::printf("\n");
    }
}

std::string text(std::uint64_t number) { return std::to_string(number); }

void register_all() {
    const std::int64_t rounds = quick ? 2 : 31;
    const auto add = [&](const std::string& name, const std::function<void(benchmark::State&)>& run) {
        benchmark::RegisterBenchmark(name.c_str(), [run](benchmark::State& state) { run(state); })
            ->Iterations(rounds)
            ->UseManualTime()
            ->Unit(benchmark::kMicrosecond);
    };
    const auto synthetic_rig = [&](const std::string& family, const Shape& shape, std::size_t active) {
        const std::string name = family + "/" + text(shape.vertices) + " vertices, " + text(active) + " of " +
                                 text(shape.targets) + " targets";
        add(name, [=](benchmark::State& state) { positions(state, name, synthetic(shape), active); });
    };
    const auto synthetic_crowd = [&](const Shape& shape, std::size_t faces, std::size_t active) {
        const std::string name = "crowd/" + text(shape.vertices) + " vertices, " + text(faces) + " faces, " +
                                 text(active) + " of " + text(shape.targets);
        add(name, [=](benchmark::State& state) { crowd(state, name, synthetic(shape), faces, active); });
    };
    if (quick) {
        synthetic_rig("vertices", {5'000, 57, 1'250}, 10);
        synthetic_rig("targets", {1'000, 8'192, 20}, 10);
        synthetic_crowd({3'001, 57, 750}, 3, 10);
        const Shape shape{3'001, 57, 750, true};
        add("normals", [=](benchmark::State& state) { directions(state, "normals", synthetic(shape), 10); });
        return;
    }
    for (const std::size_t active : {1U, 10U, 57U}) {
        const std::string name = "ICT/" + text(active) + " of 57 targets";
        add(name, [=](benchmark::State& state) {
            const auto archive = test::shared_data("faces/ict-facekit/ict_expr.tar.xz");
            const std::optional<Face> head = archive ? bench::ict_head(*archive) : std::nullopt;
            if (!head) return state.SkipWithError("the ICT head is not there (or tar cannot read it)");
            positions(state, name, *head, active);
        });
    }
    for (const std::uint32_t vertices : {5'000U, 26'719U, 100'000U, 300'000U, 1'000'000U}) {
        synthetic_rig("vertices", {vertices, 57, vertices / 4}, 10);
    }
    for (const std::uint32_t targets : {50U, 500U, 2'048U, 8'192U}) {
        synthetic_rig("targets", {5'000, targets, 1'250}, 10);
    }
    synthetic_rig("targets", {26'719, 8'192, 1'000}, 10);
    synthetic_rig("targets", {1'000'000, 50, 250'000}, 10);
    for (const std::size_t active : {1U, 3U, 10U, 30U, 57U}) synthetic_rig("active", {26'719, 57, 6'679}, active);
    for (const std::size_t faces : {1U, 4U, 16U, 64U}) synthetic_crowd({26'719, 57, 6'679}, faces, 10);
    synthetic_crowd({300'000, 57, 75'000}, 8, 10);
    for (const std::uint32_t vertices : {26'719U, 300'000U}) {
        const std::string name = "normals/" + text(vertices) + " vertices, 10 of 57 targets";
        const Shape shape{vertices, 57, vertices / 4, true};
        add(name, [=](benchmark::State& state) { directions(state, name, synthetic(shape), 10); });
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<char*> arguments(argv, argv + argc);
    quick = std::erase_if(arguments, [](const char* argument) { return std::strcmp(argument, "--quick") == 0; }) > 0;
    int count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
    register_all();
    benchmark::RunSpecifiedBenchmarks();
    print_rows();
    return all_equal ? 0 : 1;
}
