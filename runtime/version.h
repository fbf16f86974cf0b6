#pragma once
/// Which blush this is. The one place where the version is written down: CMakeLists.txt reads it here.

#define BLUSH_VERSION_MAJOR 0
#define BLUSH_VERSION_MINOR 1
#define BLUSH_VERSION_PATCH 0

namespace blush {

struct Version {
    int major = BLUSH_VERSION_MAJOR, minor = BLUSH_VERSION_MINOR, patch = BLUSH_VERSION_PATCH;
    bool operator==(const Version&) const = default;
};

/// Of the libraries that are linked; another than `Version{}` where headers and libraries are not of one installation.
Version version();

}  // namespace blush
