#include "tools/blush/picture_size.h"

#include <charconv>

namespace blush::tool {

Result<Size> parse_size(const std::string& text) {
    constexpr std::uint32_t largest_side = 16'384;  // what GL 4.5 devices commonly draw to
    Size size;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    const bool crossed = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    const auto height = crossed ? std::from_chars(width.ptr + 1, end, size.height) : width;
    if (!crossed || height.ec == std::errc::invalid_argument || height.ptr != end) {
        return Error{"--size " + text + ": not WIDTHxHEIGHT in pixels, like 960x960"};
    }
    const bool overflow = height.ec == std::errc::result_out_of_range;
    if (overflow || size.width == 0 || size.height == 0 || size.width > largest_side || size.height > largest_side) {
        return Error{"--size " + text + ": a side may be 1 to " + std::to_string(largest_side) + " pixels"};
    }
    return size;
}

}  // namespace blush::tool
