/// blush render: one frame into a file.

#include <iostream>
#include <memory>

#include "runtime/files/output_file.h"
#include "tools/blush/commands.h"
#include "tools/blush/plan.h"
#include "tools/blush/still.h"

namespace blush::tool {
namespace {

Status write(const StillOptions& options, const Still& still) {
    if (options.report.empty()) return write_image(options.output, still.picture);
    // Both files or none.
    return write_beside(options.report, [&](const std::filesystem::path& beside) {
        Status written = write_file(beside, text_of(still.plan));
        return written ? write_image(options.output, still.picture) : written;
    });
}

int render(const StillOptions& options) {
    const Result<Still> still = draw_still(options);
    if (!still) return fail(still.error());
    if (Status written = write(options, *still); !written) return fail(written.error());
    const bool linear = output_of(options.output) == Output::linear_hdr;
    std::cout << options.output << ": " << options.shot.size << (linear ? ", linear radiance\n" : ", sRGB\n");
    return 0;
}

}  // namespace

void add_render(Command& program) {
    auto options = std::make_shared<StillOptions>();
    Command command = program.subcommand("render", "Draw one frame without a window");
    options->add_to(command);
    command
        .option("-o,--output", &options->output,
                "A .png (sRGB) or .exr (linear radiance) file; .jpg, .tif and .hdr work too")
        .required();
    command.runs([options] { return render(*options); });
}

}  // namespace blush::tool
