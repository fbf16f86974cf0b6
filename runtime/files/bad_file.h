#pragma once
/// How this room says that a file is bad. Inside runtime/files a bad file throws BadFile; load_face() is the one place
/// that catches it (with whatever the libraries throw) and turns it into an Error.

#include <string>
#include <string_view>

namespace blush::load {

struct BadFile {
    std::string place;   ///< "meshes[0].primitives[1].indices", or empty for the file as a whole
    std::string reason;  ///< one sentence without its full stop
};

[[noreturn]] inline void refuse(std::string_view place, std::string_view reason) {
    throw BadFile{std::string(place), std::string(reason)};
}

/// "meshes[3]": one step of a place.
inline std::string at(std::string_view array, std::size_t index) {
    return std::string(array) + "[" + std::to_string(index) + "]";
}

}  // namespace blush::load
