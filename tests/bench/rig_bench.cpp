// A whole rig evaluation, controls to pose: 52 ARKit targets with the library of expressions and 50 correctives, at
// rest, in an emotion, in a recorded pose (every shape at some weight), and with everything on at once. The aim is 10
// microseconds a face. Each benchmark first holds its pose to what a plain computation gives.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/rig/controls/named_face.h"
#include "tests/test_faces.h"

namespace blush {
namespace {

constexpr std::size_t corrective_count = 50;

/// ARKit's shapes, and combinations of each two neighbours of the list until there are enough.
Face face_with_correctives() {
    std::vector<std::string> names(arkit_names.begin(), arkit_names.end());
    for (std::size_t i = 0; i < corrective_count; ++i) names.push_back(names[i] + "_" + names[i + 1]);
    return test::named_face(names);
}

enum class Load : std::int64_t { rest, emotion, recorded, everything };

void set_controls(test::PosedRig& posed, Load load) {
    test::Random random(1);
    for (std::size_t c = 0; c < posed.controls.size(); ++c) {
        const ControlKind kind = posed.rig.info(static_cast<ControlId>(c)).kind;
        const bool shape = kind == ControlKind::target && c < arkit_names.size();
        if (load == Load::everything || (load == Load::recorded && shape))
            posed.controls[c] = random.between(0.05F, 0.6F);
    }
    if (load == Load::emotion) posed.controls[posed.at("fear")] = 0.8F;
}

/// Of correctives, the product of their drivers; of a recorded pose, the weights that were set.
bool as_expected(const test::PosedRig& posed, Load load) {
    if (load == Load::rest) return std::ranges::all_of(posed.pose.weights, [](float weight) { return weight == 0; });
    for (std::size_t i = 0; i < corrective_count; ++i) {
        const float wanted = posed.pose.acting[i] * posed.pose.acting[i + 1];
        const float set = posed.controls[arkit_names.size() + i];
        if (std::abs(posed.pose.weights[arkit_names.size() + i] - set - wanted) > 1e-5F) return false;
        if (load == Load::recorded && posed.pose.weights[i] != posed.controls[i]) return false;
    }
    return true;
}

void evaluate(benchmark::State& state) {
    test::PosedRig posed(face_with_correctives());
    const auto load = static_cast<Load>(state.range(0));
    set_controls(posed, load);
    posed.rig.evaluate(posed.controls, posed.pose);
    if (posed.rig.program().correctives.size() != corrective_count || !as_expected(posed, load)) {
        state.SkipWithError("the pose is not what it should be");
        return;
    }
    for (auto round : state) {
        static_cast<void>(round);
        posed.rig.evaluate(posed.controls, posed.pose);
        benchmark::DoNotOptimize(posed.pose.weights.data());
        benchmark::ClobberMemory();
    }
    constexpr const char* names[] = {"at rest", "one emotion", "a recorded pose", "everything at once"};
    state.SetLabel(names[state.range(0)]);
    const auto acting = std::ranges::count_if(posed.pose.acting, [](float value) { return value != 0; });
    state.counters["controls"] = static_cast<double>(posed.controls.size());
    state.counters["acting"] = static_cast<double>(acting);
}
BENCHMARK(evaluate)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);

/// How the cost grows with targets that nothing drives.
void evaluate_many_targets(benchmark::State& state) {
    std::vector<std::string> names(arkit_names.begin(), arkit_names.end());
    for (std::int64_t i = 0; i < state.range(0); ++i) names.push_back("t" + std::to_string(i));
    test::PosedRig posed(test::named_face(names));
    posed.controls[posed.at("fear")] = 0.8F;
    for (auto round : state) {
        static_cast<void>(round);
        posed.rig.evaluate(posed.controls, posed.pose);
        benchmark::DoNotOptimize(posed.pose.weights.data());
        benchmark::ClobberMemory();
    }
    state.counters["targets"] = static_cast<double>(names.size());
}
BENCHMARK(evaluate_many_targets)->Arg(0)->Arg(1024)->Arg(8192)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace blush

BENCHMARK_MAIN();
