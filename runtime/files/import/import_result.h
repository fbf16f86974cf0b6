#pragma once
/// From an importer's Face to its result; the one place where an importer's exceptions end.

#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "runtime/files/bad_file.h"
#include "runtime/files/gltf/glb_writer.h"
#include "runtime/files/import/import_head.h"

namespace blush::load {

/// `import()` gives a Result<ImportedHead> or throws.
template <class Import>
Result<ImportedHead> guarded(const std::filesystem::path& path, Import import) {
    const std::string name = path.string();
    try {
        return import();
    } catch (const BadFile& bad) {
        return Error{name + ": " + (bad.place.empty() ? "" : bad.place + ": ") + bad.reason};
    } catch (const std::bad_alloc&) {
        return Error{name + ": there is not enough memory to import this head"};
    } catch (const std::exception& error) {
        return Error{name + ": the head cannot be imported (" + error.what() + ")"};
    }
}

inline Result<ImportedHead> write_head(Face face, std::span<const PackedImage> images, std::vector<std::string> notes) {
    Result<std::string> glb = glb_bytes(face, images, "blush import");
    if (!glb) return glb.error();
    return ImportedHead{std::move(*glb), face.positions.size(), face.indices.size() / 3, face.targets.size(),
                        std::move(notes)};
}

}  // namespace blush::load
