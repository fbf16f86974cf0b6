#include "runtime/measure/accuracy.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "rig/head/face_scale.h"
#include "runtime/measure/studies.h"

namespace blush {
namespace {

/// Value at a share (0 to 1) of the sorted values, the nearest rank.
double quantile(std::vector<double> values, double share) {
    const auto rank = static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
    std::ranges::nth_element(values, values.begin() + rank);
    return values[static_cast<std::size_t>(rank)];
}

double run_milliseconds(const Variant& variant) {
    const auto start = std::chrono::steady_clock::now();
    variant.run();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    return elapsed.count();
}

void mark_frontier(std::vector<MeasuredVariant>& variants) {
    for (MeasuredVariant& variant : variants) {
        variant.on_frontier = std::ranges::none_of(variants, [&](const MeasuredVariant& other) {
            const bool no_worse = other.median_ms <= variant.median_ms && other.error_worst <= variant.error_worst;
            const bool better = other.median_ms < variant.median_ms || other.error_worst < variant.error_worst;
            return no_worse && better;
        });
    }
}

MeasuredStudy measure(const Study& study, std::string_view effect, std::size_t rounds) {
    MeasuredStudy measured{std::string(effect), study.name, study.reference, study.unit, {}};
    std::vector<std::vector<double>> times(study.variants.size());
    for (const Variant& variant : study.variants) variant.run();  // warm caches and lazily made buffers
    for (std::size_t round = 0; round < rounds; ++round) {
        for (std::size_t v = 0; v < study.variants.size(); ++v) {
            times[v].push_back(run_milliseconds(study.variants[v]));
        }
    }
    const auto chosen = std::ranges::find_if(study.variants, &Variant::is_default);
    const auto default_index = static_cast<std::size_t>(chosen - study.variants.begin()) % study.variants.size();
    for (std::size_t v = 0; v < study.variants.size(); ++v) {
        const Variant& variant = study.variants[v];
        std::vector<double> ratios;
        for (std::size_t round = 0; round < rounds; ++round) {
            ratios.push_back(times[v][round] / times[default_index][round]);
        }
        const Variant::Error error = variant.error();
        measured.variants.push_back({variant.label, variant.work, variant.is_default, error.mean, error.worst,
                                     quantile(times[v], 0.5), quantile(times[v], 0.25), quantile(times[v], 0.75),
                                     quantile(ratios, 0.5), quantile(ratios, 0.25), quantile(ratios, 0.75),
                                     error.channel_mean, error.channel_worst, false});
    }
    mark_frontier(measured.variants);
    return measured;
}

}  // namespace

Result<AccuracyReport> measure_accuracy(const Device& device, const Face& face, const AccuracyOptions& options) {
    AccuracyReport report;
    report.face = face.path;
    report.renderer = device.info().renderer;
    report.rounds = options.quick ? 7 : 41;  // odd, so that the median is a measured value
    report.millimetres_a_unit =
        options.millimetres_a_unit > 0 ? options.millimetres_a_unit : face_scale(face).millimetres_a_unit;
    std::string known;
    bool found = false;
    for (const Studied& what : studied()) {
        const std::string name(what.name);
        known += (known.empty() ? "" : ", ") + name;
        if (!options.effect.empty() && name != options.effect) continue;
        found = true;
        if (what.make == nullptr) {
            if (options.effect.empty()) continue;
            return Error{name + " has no study, since " + std::string(what.why_none)};
        }
        for (const Study& study : what.make(device, face, report.millimetres_a_unit, options.quick)) {
            if (options.progress) options.progress(name + ": " + study.name);
            if (!study.variants.empty()) report.studies.push_back(measure(study, name, report.rounds));
        }
    }
    if (!found) return Error{"no effect is called \"" + options.effect + "\" (there are: " + known + ")"};
    return report;
}

}  // namespace blush
