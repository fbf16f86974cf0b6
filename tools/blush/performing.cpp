#include "tools/blush/performing.h"

#include <charconv>
#include <cmath>
#include <iostream>

#include "runtime/files/performance/performance_file.h"
#include "tools/blush/assets.h"
#include "tools/blush/playback.h"

namespace blush::tool {
namespace {

namespace fs = std::filesystem;

std::optional<double> number_in(std::string_view text) {
    double value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

Result<std::optional<double>> blood_speed(const std::string& text) {
    if (text == "at-once") return std::optional<double>();
    if (text == "slow") return std::optional<double>(1);
    constexpr std::string_view slow_at = "slow:";
    if (text.starts_with(slow_at)) {
        const std::optional<double> speed = number_in(std::string_view(text).substr(slow_at.size()));
        if (speed && *speed >= 0.01 && *speed <= 1000) return speed;
    }
    return Error{"--blood " + text + ": not at-once, slow, or slow:SPEED with a speed from 0.01 to 1000"};
}

Result<Marker> event_in(const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::optional<double> seconds =
        equals == std::string::npos ? std::nullopt : number_in(std::string_view(text).substr(0, equals));
    if (!seconds || *seconds < 0 || *seconds > 1e6 || equals + 1 == text.size()) {
        return Error{"--event " + text + ": not SECONDS=NAME, like 2.5=poke"};
    }
    return Marker{.time_seconds = static_cast<float>(*seconds), .event = text.substr(equals + 1), .text = {}};
}

Result<Performance> performance_for_script(const Face& face, const fs::path& folder, const std::string& name) {
    if (name.empty() || name.find_first_of("/\\") != std::string::npos || name.starts_with('.')) {
        return Error{"'" + name + "' is not the name of a performance; a path is none"};
    }
    std::error_code failed;
    for (const char* ending : {"", ".json", ".csv"}) {
        const fs::path beside = folder / (name + ending);
        if (fs::is_regular_file(beside, failed)) return load_performance(beside);
    }
    return find_performance(face, name);
}

}  // namespace

void PerformOptions::add_to(Command& command) {
    command.option("--script", &script, "A Lua script (docs/scripting.md), or a shipped one by name");
    command.option("--seed", &seed, "Of what the script and life do by chance").shows_default();
    command
        .option("--life", &life,
                "Blinks, gaze, breath, small movements of the head: on, off, or talking; on with a script")
        .one_of({"on", "off", "talking"});
    command
        .option("--blood", &blood,
                "When the blood of states such as blush comes and goes: at-once, slow, or slow:SPEED")
        .shows_default();
    command.option("--event", &events, "An event for the script, SECONDS=NAME; may be given several times");
}

void PerformOptions::add_moment_to(Command& command) {
    add_to(command);
    command.option("--at", &at_seconds, "The moment to show of the script or of life, seconds")
        .range(0, 3600)
        .shows_default();
}

Status perform_moment(const Face& face, const Rig& rig, const PerformOptions& options, std::span<float> controls,
                      Pose& pose) {
    Result<PerformerParts> parts = options.parts(face, rig, controls, std::nullopt);
    if (!parts) return parts.error();
    Performer performer(rig, *std::move(parts));
    if (Status played = performer.seek(options.at_seconds); !played) return played;
    performer.write(controls, pose);
    return Done{};
}

Result<PerformerParts> PerformOptions::parts(const Face& face, const Rig& rig, std::span<const float> base,
                                             std::optional<BoundPerformance> timeline) const {
    PerformerParts parts;
    parts.base.assign(base.begin(), base.end());
    parts.timeline = std::move(timeline);
    const Result<std::optional<double>> speed = blood_speed(blood);
    if (!speed) return speed.error();
    parts.blood_speed = *speed;
    for (const std::string& text : events) {
        Result<Marker> event = event_in(text);
        if (!event) return event.error();
        parts.events.push_back(*std::move(event));
    }
    if (life == "on" || life == "talking" || (life.empty() && !script.empty())) {
        parts.life = LifeSettings{.seed = seed, .talking = life == "talking"};
    }
    if (script.empty()) return parts;
    const Result<fs::path> path = find_script(script);
    if (!path) return path.error();
    ScriptOptions options;
    options.seed = seed;
    options.find_performance = performances_for_script(face, *path);
    options.print = [](std::string_view line) { std::cerr << "script: " << line << "\n"; };
    Result<Script> loaded = Script::load(*path, rig, std::move(options));
    if (!loaded) return loaded.error();
    parts.script = *std::move(loaded);
    return parts;
}

Result<fs::path> find_script(const std::string& name) {
    std::error_code failed;
    const fs::path ours = asset_folder() / "scripts" / (name + ".lua");
    if (name.find('/') == std::string::npos && fs::exists(ours, failed)) return ours;
    if (fs::exists(name, failed)) return fs::path(name);
    std::string known;
    for (const std::string& shipped_name : shipped("scripts", ".lua")) known += ", " + shipped_name;
    return Error{"--script " + name +
                 ": neither a file nor shipped (there are: " + (known.empty() ? "none" : known.substr(2)) + ")"};
}

std::function<Result<Performance>(const std::string&)> performances_for_script(const Face& face,
                                                                               const fs::path& script) {
    return [&face, folder = script.parent_path()](const std::string& name) {
        return performance_for_script(face, folder, name);
    };
}

Result<std::optional<BoundPerformance>> find_timeline(const Face& face, const Rig& rig, const std::string& name,
                                                      const PerformOptions& options) {
    if (name.empty() && !options.script.empty()) return std::optional<BoundPerformance>();
    Result<Performance> performance = find_performance(face, name);
    if (!performance) return performance.error();
    std::optional<BoundPerformance> bound(std::in_place, *std::move(performance), rig);
    report_matches(*bound, face);
    return bound;
}

Result<float> duration_of(Performer& performer, float endless_seconds) {
    constexpr double longest_seconds = 600;
    const Result<std::optional<double>> end = performer.find_end(longest_seconds);
    if (!end) return end.error();
    const bool endless = !*end || (**end == 0 && !performer.still());
    return endless ? endless_seconds : static_cast<float>(**end);
}

}  // namespace blush::tool
