#include "runtime/script/lint_script.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "rig/names.h"
#include "runtime/script/script.h"

namespace blush {
namespace {

/// Calls whose first argument is the name of a control.
constexpr std::string_view takes_a_control[] = {"feel", "set", "get", "release"};

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Names in `feel("NAME"` and the like, with their lines. Comments are skipped as far as a line goes.
std::map<std::string, int> written_controls(const std::string& text) {
    std::map<std::string, int> names;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (const std::size_t comment = line.find("--"); comment != std::string::npos) line.resize(comment);
        for (const std::string_view function : takes_a_control) {
            for (std::size_t at = line.find(function); at != std::string::npos; at = line.find(function, at + 1)) {
                std::size_t next = at + function.size();
                if ((at > 0 && (is_word(line[at - 1]) || line[at - 1] == '.')) || next >= line.size()) continue;
                next = line.find_first_not_of(" \t", next);
                if (next != std::string::npos && line[next] == '(') next = line.find_first_not_of(" \t", next + 1);
                if (next == std::string::npos || (line[next] != '"' && line[next] != '\'')) continue;
                const std::size_t end = line.find(line[next], next + 1);
                if (end != std::string::npos) names.try_emplace(line.substr(next + 1, end - next - 1), number);
            }
        }
    }
    return names;
}

/// "path:12: reason" as a finding.
ScriptFinding finding_of(const std::string& message, const std::string& file) {
    std::string_view rest = message;
    if (rest.starts_with(file)) rest.remove_prefix(file.size());
    ScriptFinding finding;
    if (rest.starts_with(':')) {
        const auto read = std::from_chars(rest.data() + 1, rest.data() + rest.size(), finding.line);
        if (read.ec == std::errc()) rest.remove_prefix(static_cast<std::size_t>(read.ptr - rest.data()));
    }
    if (rest.starts_with(": ")) rest.remove_prefix(2);
    finding.sentence = rest;
    return finding;
}

class Linter {
public:
    Linter(const std::filesystem::path& path, const Rig& rig) : path_(path), rig_(rig) {}

    Result<std::vector<ScriptFinding>> run(std::function<Result<Performance>(const std::string&)> find_performance) {
        std::ifstream stream(path_, std::ios::binary);
        const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
        ScriptOptions options;
        options.find_performance = std::move(find_performance);
        options.unknown_control = [this](const std::string& name, int line) { unknown_.try_emplace(name, line); };
        options.event_used = [this](const std::string& event) { events_.insert(event); };
        Result<Script> script = Script::load(path_, rig_, options);
        if (!script) {
            // A file that cannot be read is an error; text that does not compile is what a linter is for.
            std::error_code failed;
            if (!std::filesystem::is_regular_file(path_, failed)) return script.error();
            findings_.push_back(finding_of(script.error().message, path_.string()));
            return std::move(findings_);
        }
        play(*script, options.limits);
        for (const auto& [name, line] : written_controls(text)) {
            if (!rig_.find(name)) unknown_.try_emplace(name, line);
        }
        for (const auto& [name, line] : unknown_) {
            const std::optional<std::string> near = nearest_name(name, rig_.control_names());
            findings_.push_back(
                {line, "there is no control '" + name + "'" + (near ? " (did you mean '" + *near + "'?)" : "")});
        }
        std::ranges::stable_sort(findings_, {}, &ScriptFinding::line);
        return std::move(findings_);
    }

private:
    void play(Script& script, const ScriptLimits& limits) {
        constexpr int steps_a_second = 30, seconds = 60;
        const std::vector<float> below(rig_.control_names().size(), 0);
        std::vector<float> controls = below;
        std::set<std::string> sent;
        std::int64_t most_instructions = 0;
        double at_seconds = 0;
        bool moved = false;
        for (int step = 0; step <= steps_a_second * seconds; ++step) {
            if (step % steps_a_second == 0) {
                const auto next = std::ranges::find_if(events_, [&](const auto& e) { return !sent.contains(e); });
                if (next != events_.end()) script.emit(*sent.insert(*next).first, "", script.now_seconds());
            }
            if (Status played = script.step(step == 0 ? 0 : 1.0 / steps_a_second, below); !played) {
                findings_.push_back(finding_of(played.error().message, path_.string()));
                return;
            }
            if (script.instructions_of_last_step() > most_instructions) {
                most_instructions = script.instructions_of_last_step();
                at_seconds = script.now_seconds();
            }
            controls = below;
            script.apply(controls);
            moved = moved || controls != below || script.gaze().wished || script.blinks_wished() > 0;
        }
        if (most_instructions > limits.instructions_a_step / 2) {
            findings_.push_back({0, "the step at " + std::to_string(at_seconds) + " s takes " +
                                        std::to_string(most_instructions) + " of the " +
                                        std::to_string(limits.instructions_a_step) + " instructions that it may"});
        }
        if (!moved && unknown_.empty()) findings_.push_back({0, "nothing moves in the first minute"});
    }

    std::filesystem::path path_;
    const Rig& rig_;
    std::map<std::string, int> unknown_;
    std::set<std::string> events_;
    std::vector<ScriptFinding> findings_;
};

}  // namespace

Result<std::vector<ScriptFinding>> lint_script(
    const std::filesystem::path& path, const Rig& rig,
    std::function<Result<Performance>(const std::string&)> find_performance) {
    return Linter(path, rig).run(std::move(find_performance));
}

}  // namespace blush
