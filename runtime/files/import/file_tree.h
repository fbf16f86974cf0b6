#pragma once
/// The files of a folder or of an archive (libarchive: tar, zip and others, compressed or not), one after the other.

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "runtime/files/bytes.h"

namespace blush::load {

/// What may be taken from an archive or a folder that is not trusted. Sizes are of what really comes out, whatever the
/// headers say.
struct TreeLimits {
    std::uint64_t file_bytes = 256ULL << 20;  ///< of one file
    std::uint64_t all_bytes = 4ULL << 30;     ///< of all files that are used
    std::size_t entries = 100'000;            ///< files and folders passed by
};

/// The part of a name behind its last '/'.
std::string_view file_name(std::string_view name);

/// Calls `use` with the content of every regular file whose name `wanted` accepts. Names are relative to the folder or
/// archive and divided by '/'; a folder's come in ascending order, an archive's in its own. Links are not followed.
/// Nothing is written to the disk; a name that leads out of the archive ("../x", "/x") refuses it all the same. Throws
/// BadFile.
void each_file(const std::filesystem::path& folder_or_archive, const std::function<bool(std::string_view)>& wanted,
               const std::function<void(const std::string&, Bytes)>& use, const TreeLimits& limits = {});

}  // namespace blush::load
