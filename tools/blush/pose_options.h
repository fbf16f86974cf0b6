#pragma once
/// --set, --emotion, --state, --rig, --defaults, --setting: what a frame starts from.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rig/controls/rig.h"
#include "tools/command_line/command_line.h"

namespace blush::tool {

struct PoseOptions {
    std::vector<std::string> sets;      ///< "jawOpen=0.6", several separated by commas
    std::vector<std::string> emotions;  ///< the same, of emotions and compounds alone
    std::vector<std::string> states;    ///< the same, of physiological states alone
    std::string rig_file;               ///< a rig description; empty: what stands beside the face
    std::vector<std::string> settings;  ///< "deformation.method=passes"
    bool defaults = false;              ///< start from the file's own weights instead of zero

    void add_to(Command& command);
    /// Writes one value for each control of the rig. Error: an unknown control (with the nearest one), a bad number.
    Status apply(const Face& face, const Rig& rig, std::span<float> controls) const;
    /// Hands each setting to `set`, whose error it names.
    Status apply_settings(const std::function<Status(std::string_view name, std::string_view value)>& set) const;
};

}  // namespace blush::tool
