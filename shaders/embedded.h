#pragma once
/// The shader files of this folder, as they were when the library was built.

#include <span>
#include <string_view>

namespace blush {

struct EmbeddedShader {
    std::string_view name;  ///< file name, such as "deform/deform.vert"
    std::string_view text;
};

std::span<const EmbeddedShader> embedded_shaders();

}  // namespace blush
