#pragma once
/// What a study is: ways to do one task, how long each takes, and how far each is from an exact twin.

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace blush {

/// One way to compute something, to be compared with others: how long `run` takes, how far `error` says it is off.
struct Variant {
    std::string label;          ///< "deformation.method=sparse"
    std::function<void()> run;  ///< complete when it returns
    struct Error {
        double mean = 0, worst = 0;  ///< in the study's unit
        /// Of red, green and blue apart, where a study tells; else zero.
        std::array<double, 3> channel_mean{}, channel_worst{};
    };
    std::function<Error()> error;
    std::string work;  ///< counted: "52 targets, 14 passes, 1.4 M deltas"
    bool is_default = false;
};

/// Variants of one task on one face, with the reference that their errors are measured against.
struct Study {
    std::string name;       ///< "52 of 52 targets active, 26,719 vertices"
    std::string reference;  ///< "the sum in double precision on the CPU"
    std::string unit;       ///< "mm", "degrees", "CIEDE2000"
    std::vector<Variant> variants;
    std::shared_ptr<void> keeps;  ///< whatever the variants' functions refer to
};

}  // namespace blush
