/// blush: the command.

#include <csignal>
#include <iostream>

#include "tools/blush/options.h"

int main(int argc, char** argv) {
    // A closed pipe (`blush info FACE | head`, or a video encoder that gave up) is an error to report, not a death.
    std::signal(SIGPIPE, SIG_IGN);

    CLI::App app("blush: faces that move, wrinkle and flush. Every command explains itself: blush COMMAND --help.");
    app.require_subcommand(1);
    app.set_version_flag("--version", BLUSH_VERSION);
    int exit_status = 0;
    blush::tool::add_info(app, exit_status);
    blush::tool::add_import(app, exit_status);
    blush::tool::add_evaluate(app, exit_status);
    blush::tool::add_render(app, exit_status);
    blush::tool::add_play(app, exit_status);
    blush::tool::add_explain(app, exit_status);
    blush::tool::add_kernel(app, exit_status);
    blush::tool::add_accuracy(app, exit_status);
    blush::tool::add_bake(app, exit_status);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
        std::string reason = error.what();
        const std::string command = argc > 1 ? argv[1] : "";
        if (app.get_subcommands().empty() && !command.empty() && command.front() != '-') {
            reason = "there is no command \"" + command + "\" (there are:";
            for (const CLI::App* known : app.get_subcommands({})) reason += " " + known->get_name();
            reason += ")";
        }
        return blush::tool::fail({reason});
    }
    // What was printed is a result too: a full disk or a closed pipe lost some of it.
    std::cout.flush();
    if (exit_status == 0 && !std::cout) return blush::tool::fail({"standard output: cannot be written"});
    return exit_status;
}
