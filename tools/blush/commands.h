#pragma once
/// The commands: each function adds one to `program`, or a subcommand to `bake_command`.

#include "rig/result.h"
#include "tools/command_line/command_line.h"

namespace blush::tool {

/// Prints the sentence on standard error and returns bad_input.
int fail(const Error& error);

void add_info(Command& program);
void add_import(Command& program);
void add_evaluate(Command& program);
void add_render(Command& program);
void add_play(Command& program);
void add_explain(Command& program);
void add_accuracy(Command& program);
void add_controls(Command& program);
void add_lint(Command& program);
void add_kernel(Command& program);
void add_bake(Command& program);
void add_antialias(Command& program);

void add_bake_appearance(Command& bake_command);
void add_bake_face(Command& bake_command);
void add_bake_wrinkles(Command& bake_command);
void add_bake_occlusion(Command& bake_command);
void add_bake_smaa_tables(Command& bake_command);

}  // namespace blush::tool
