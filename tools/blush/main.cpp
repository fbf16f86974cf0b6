/// blush: the command.

#include <csignal>
#include <iostream>

#include "tools/blush/commands.h"

namespace blush::tool {

int fail(const Error& error) {
    std::cerr << "blush: " << error.message << "\n";
    return bad_input;
}

}  // namespace blush::tool

int main(int argc, char** argv) {
    using namespace blush;
    // A closed pipe (`blush info FACE | head`, or a video encoder that gave up) is an error to report, not a death.
    std::signal(SIGPIPE, SIG_IGN);

    CommandLine words(
        "blush", "blush: faces that move, wrinkle and flush. Every command explains itself: blush COMMAND --help.");
    words.set_version(BLUSH_VERSION);
    Command program = words.command();
    program.needs_a_subcommand();
    tool::add_info(program);
    tool::add_import(program);
    tool::add_evaluate(program);
    tool::add_render(program);
    tool::add_play(program);
    tool::add_explain(program);
    tool::add_kernel(program);
    tool::add_accuracy(program);
    tool::add_controls(program);
    tool::add_lint(program);
    tool::add_bake(program);
    tool::add_antialias(program);
    const int exit_status = words.run(argc, argv);
    // What was printed is a result too: a full disk or a closed pipe lost some of it.
    std::cout.flush();
    if (exit_status == 0 && !std::cout) return tool::fail({"standard output: cannot be written"});
    return exit_status;
}
