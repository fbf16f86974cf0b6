#pragma once
/// What moves a face beside a performance: a script, life, slow blood, events.

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/script/performer.h"
#include "tools/command_line/command_line.h"

namespace blush::tool {

/// --script, --seed, --life, --blood, --event.
struct PerformOptions {
    std::string script;               ///< a file, or a shipped one by name; empty: none
    std::string life;                 ///< "on", "off", "talking"; empty: on with a script
    std::string blood = "at-once";    ///< or "slow", or "slow:10" for ten times as fast
    std::vector<std::string> events;  ///< "2.5=poke"
    std::uint64_t seed = 1;
    double at_seconds = 0;

    void add_to(Command& command);
    /// --at, for commands that show one moment.
    void add_moment_to(Command& command);
    /// Loads what the options name, for a face. `base` has one value for each control of the rig. Error: the script's,
    /// or an option that is not of its form.
    Result<PerformerParts> parts(const Face& face, const Rig& rig, std::span<const float> base,
                                 std::optional<BoundPerformance> timeline) const;
};

/// Writes the controls of the moment that the options name; leaves them as they are where nothing moves the face.
/// Error: as parts(), or the script's.
Status perform_moment(const Face& face, const Rig& rig, const PerformOptions& options, std::span<float> controls,
                      Pose& pose);

/// The script that a user means: a file, or a shipped one by name. Error: neither, with what there is.
Result<std::filesystem::path> find_script(const std::string& name);

/// What play() may play in the script of that file: an animation of the face, a shipped performance, or one beside the
/// script; names only, no paths.
std::function<Result<Performance>(const std::string&)> performances_for_script(const Face& face,
                                                                               const std::filesystem::path& script);

/// The performance that a command plays: the one of that name; with a script and no name, none. Says on standard error
/// which channels and targets do not match.
Result<std::optional<BoundPerformance>> find_timeline(const Face& face, const Rig& rig, const std::string& name,
                                                      const PerformOptions& options);

/// How long to play it: until all has come to its end, or for `endless_seconds`. Error: the script's.
Result<float> duration_of(Performer& performer, float endless_seconds);

}  // namespace blush::tool
