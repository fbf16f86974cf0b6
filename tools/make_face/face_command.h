#pragma once
/// The options that make_face and `blush bake face` share.

#include <filesystem>
#include <string>
#include <vector>

#include "tools/command_line/command_line.h"
#include "tools/make_face/build_face.h"

namespace blush::make_face {

struct FaceCommand {
    std::string output, preset;
    std::vector<std::string> sets;
    std::size_t vertices = 22'000;
    int texture_side = default_texture_side;
    bool maps = false;
    bool list = false;

    void add_to(Command& command);
    /// Writes the file, or prints the list. `preset_folder`: where named presets stand, beside the hemoglobin patterns.
    Status run(const std::filesystem::path& preset_folder) const;

private:
    Result<Person> person(const std::filesystem::path& preset_folder) const;
};

}  // namespace blush::make_face
