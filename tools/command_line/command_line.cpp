#include "tools/command_line/command_line.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <type_traits>

#include <CLI/CLI.hpp>

namespace blush {
namespace {

/// CLI11's own range lets NaN pass.
CLI::Validator finite_range(double low, double high) {
    const auto plain = [](double value) {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%g", value);
        return std::string(text.data());
    };
    const std::string range = plain(low) + " to " + plain(high);
    const auto check = [low, high, range](std::string& text) -> std::string {
        double value = 0;
        const char* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data(), end, value);
        const bool good = read.ec == std::errc() && read.ptr == end && value >= low && value <= high;  // false for NaN
        return good ? "" : "\"" + text + "\" is not a number from " + range;
    };
    return CLI::Validator(check, "from " + range);
}

/// Why the words could not be read; an unknown command is named with those that there are.
std::string reason_of(const CLI::ParseError& error, const CLI::App& app, const std::string& first_word) {
    const bool has_commands = !app.get_subcommands({}).empty();
    const bool named_one = !first_word.empty() && first_word.front() != '-';
    if (!has_commands || !named_one || !app.get_subcommands().empty()) return error.what();
    std::string reason = "there is no command \"" + first_word + "\" (there are:";
    for (const CLI::App* known : app.get_subcommands({})) reason += " " + known->get_name();
    return reason + ")";
}

}  // namespace

Option& Option::required() {
    option_->required();
    return *this;
}

Option& Option::shows_default() {
    option_->capture_default_str();
    return *this;
}

Option& Option::range(double low, double high) {
    option_->check(whole_ ? CLI::Range(static_cast<std::int64_t>(low), static_cast<std::int64_t>(high))
                          : finite_range(low, high));
    return *this;
}

Option& Option::one_of(const std::vector<std::string>& words) {
    option_->check(CLI::IsMember(words));
    return *this;
}

Option& Option::split_at_commas() {
    option_->delimiter(',');
    return *this;
}

Option& Option::hidden() {
    option_->group("");
    return *this;
}

Option& Option::excludes(const Option& other) {
    option_->excludes(other.option_);
    return *this;
}

Command Command::subcommand(const std::string& name, const std::string& meaning) {
    return {app_->add_subcommand(name, meaning), exit_status_};
}

void Command::needs_a_subcommand() { app_->require_subcommand(1); }

Option Command::option(const std::string& names, OptionTarget target, const std::string& meaning) {
    return std::visit(
        [&](auto* value) {
            using Value = std::remove_pointer_t<decltype(value)>;
            constexpr bool whole = std::is_integral_v<Value> || std::is_same_v<Value, std::optional<std::int32_t>>;
            return Option(app_->add_option(names, *value, meaning), whole);
        },
        target);
}

Option Command::flag(const std::string& names, bool& target, const std::string& meaning) {
    return {app_->add_flag(names, target, meaning), false};
}

void Command::runs(std::function<int()> run) {
    app_->callback([run = std::move(run), exit_status = exit_status_] { *exit_status = run(); });
}

CommandLine::CommandLine(std::string name, const std::string& meaning)
    : name_(std::move(name)), app_(std::make_unique<CLI::App>(meaning)) {}

CommandLine::~CommandLine() = default;

void CommandLine::set_version(const std::string& version) { app_->set_version_flag("--version", version); }

Command CommandLine::command() { return {app_.get(), &exit_status_}; }

int CommandLine::run(int argc, const char* const* argv) {
    try {
        app_->parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app_->exit(error);  // --help, --version
        std::cerr << name_ << ": " << reason_of(error, *app_, argc > 1 ? argv[1] : "") << "\n";
        return bad_input;
    }
    return exit_status_;
}

}  // namespace blush
