/// blush explain: what the frame that `render` draws with the same options runs, what it leaves out, and why.

#include <iostream>
#include <memory>

#include "runtime/files/output_file.h"
#include "tools/blush/commands.h"
#include "tools/blush/plan.h"
#include "tools/blush/still.h"

namespace blush::tool {
namespace {

int explain(const StillOptions& options, bool as_json) {
    const Result<Still> still = draw_still(options);
    if (!still) return fail(still.error());
    if (!options.report.empty()) {
        if (Status written = write_file(options.report, text_of(still->plan)); !written) return fail(written.error());
    }
    if (as_json) {
        std::cout << text_of(still->plan);
    } else {
        print_plan(still->plan);
    }
    return 0;
}

}  // namespace

void add_explain(Command& program) {
    struct Options {
        StillOptions still;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    Command command =
        program.subcommand("explain", "Say what the frame that render draws runs and leaves out, and why");
    options->still.add_to(command);
    command.option("-o,--output", &options->still.output,
                   "The picture that render would write: .exr and .hdr hold radiance; nothing is written");
    command.flag("--json", options->json, "Print JSON");
    command.runs([options] { return explain(options->still, options->json); });
}

}  // namespace blush::tool
