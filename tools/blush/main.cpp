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
    blush::tool::add_evaluate(app, exit_status);
    blush::tool::add_render(app, exit_status);
    blush::tool::add_play(app, exit_status);
    blush::tool::add_explain(app, exit_status);
    blush::tool::add_accuracy(app, exit_status);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
        std::cerr << "blush: " << error.what() << "\n";
        return blush::tool::bad_input;
    }
    return exit_status;
}
