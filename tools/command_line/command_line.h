#pragma once
/// The words of a command line, and what they fill in. CLI11 reads them, in one file: it takes long to compile.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace blush {

/// Exit status of bad input (house rule).
inline constexpr int bad_input = 2;

/// What an option's words are written to; it outlives the reading.
using OptionTarget = std::variant<std::string*, std::vector<std::string>*, std::int32_t*, std::uint32_t*,
                                  std::uint64_t*, float*, double*, std::optional<std::int32_t>*, std::optional<float>*>;

/// An option of a command, with what holds for it. Errors name it and say what it may be.
class Option {
public:
    Option& required();
    /// The help text shows what the target holds now.
    Option& shows_default();
    /// Both ends are good values. No real number but a finite one is in any range.
    Option& range(double low, double high);
    Option& one_of(const std::vector<std::string>& words);
    /// "a,b" is two values.
    Option& split_at_commas();
    /// Left out of the help text.
    Option& hidden();
    Option& excludes(const Option& other);

private:
    friend class Command;
    Option(CLI::Option* option, bool whole) : option_(option), whole_(whole) {}
    CLI::Option* option_;
    bool whole_;  // the target is a whole number
};

/// A command, the program's own or one below it. A handle: valid as long as its CommandLine.
class Command {
public:
    Command subcommand(const std::string& name, const std::string& meaning);
    void needs_a_subcommand();

    /// names: "-o,--output"; without dashes, "FACE" is told by its place.
    Option option(const std::string& names, OptionTarget target, const std::string& meaning);
    /// "!--no-captions" makes the target false.
    Option flag(const std::string& names, bool& target, const std::string& meaning);

    /// Is called when the command was given and its options are good; returns the exit status.
    void runs(std::function<int()> run);

private:
    friend class CommandLine;
    Command(CLI::App* app, int* exit_status) : app_(app), exit_status_(exit_status) {}
    CLI::App* app_;
    int* exit_status_;
};

class CommandLine {
public:
    /// name: what errors begin with.
    CommandLine(std::string name, const std::string& meaning);
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    /// Adds --version.
    void set_version(const std::string& version);
    Command command();

    /// Runs the command that the words name, or prints a help text, or one sentence on standard error. Returns the exit
    /// status.
    int run(int argc, const char* const* argv);

private:
    std::string name_;
    std::unique_ptr<CLI::App> app_;
    int exit_status_ = 0;
};

}  // namespace blush
