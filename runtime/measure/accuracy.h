#pragma once
/// Error against time, for every registered effect and setting (promise 1: show what accuracy costs in time).

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "rig/face.h"
#include "rig/result.h"
#include "runtime/device.h"

namespace blush {

struct AccuracyOptions {
    std::string effect;             ///< one effect or baker by name, or empty for all
    bool quick = false;             ///< fewer rounds, and only the largest study of each effect
    double millimetres_a_unit = 0;  ///< scale of the face; 0: found from the face (rig/head/face_scale.h)
    std::function<void(std::string_view)> progress;  ///< called with each study's name as it starts; may be empty
};

struct MeasuredVariant {
    std::string label, work;
    bool is_default = false;
    double error_mean = 0, error_worst = 0;         ///< in the study's unit
    double median_ms = 0, low_ms = 0, high_ms = 0;  ///< median and quartiles of the rounds
    double ratio_to_default = 1;  ///< median over the rounds of this variant's time / the default's in the same round
    double ratio_low = 1, ratio_high = 1;                   ///< quartiles of that ratio
    std::array<double, 3> channel_mean{}, channel_worst{};  ///< of red, green and blue, where the study tells
    bool on_frontier = false;  ///< no other variant is both at least as fast and more exact
};

struct MeasuredStudy {
    std::string effect, name, reference, unit;
    std::vector<MeasuredVariant> variants;
};

struct AccuracyReport {
    std::string face, renderer;
    std::size_t rounds = 0;
    double millimetres_a_unit = 0;
    std::vector<MeasuredStudy> studies;
};

/// Runs the variants of each study in turn (A B C A B C ...), so that a change of the machine's speed meets all alike.
/// Error: no such effect, or one that has no study.
Result<AccuracyReport> measure_accuracy(const Device& device, const Face& face, const AccuracyOptions& options);

}  // namespace blush
