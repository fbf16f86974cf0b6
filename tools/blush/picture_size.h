#pragma once
/// Width and height of a picture, as --size has them.

#include <cstdint>
#include <string>

#include "rig/result.h"

namespace blush::tool {

struct Size {
    std::uint32_t width = 0, height = 0;

    float aspect() const { return static_cast<float>(width) / static_cast<float>(height); }
};
/// "960x540". Error: anything else, or a side that is not 1 to 16384.
Result<Size> parse_size(const std::string& text);

}  // namespace blush::tool
