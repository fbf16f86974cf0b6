/// blush bake: maps and tables that a face or the renderer needs, made ahead of time. One subcommand a kind.

#include "tools/blush/commands.h"

namespace blush::tool {

void add_bake(Command& program) {
    Command command = program.subcommand("bake", "Make maps and tables ahead of time");
    command.needs_a_subcommand();
    add_bake_face(command);
    add_bake_appearance(command);
    add_bake_wrinkles(command);
    add_bake_occlusion(command);
    add_bake_smaa_tables(command);
}

}  // namespace blush::tool
