/// blush bake: maps and tables that a face or the renderer needs, made ahead of time. One subcommand a kind.

#include "tools/blush/options.h"

namespace blush::tool {

void add_bake(CLI::App& app, int& exit_status) {
    CLI::App* command = app.add_subcommand("bake", "Make maps and tables ahead of time");
    command->require_subcommand(1);
    add_bake_face(*command, exit_status);
    add_bake_appearance(*command, exit_status);
    add_bake_wrinkles(*command, exit_status);
    add_bake_occlusion(*command, exit_status);
    add_bake_smaa_tables(*command, exit_status);
}

}  // namespace blush::tool
