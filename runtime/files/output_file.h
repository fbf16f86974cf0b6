#pragma once
/// Writing results: beside the destination first, then renamed over it, so that nothing half-written is left behind.

#include <filesystem>
#include <functional>
#include <span>
#include <string_view>

#include "rig/face.h"
#include "rig/result.h"

namespace blush {

/// Calls `write` with a name beside `path` (same folder and ending) and renames what it wrote over `path`. When `write`
/// fails, what it left is removed and its error is returned. Error too: a folder that does not exist or is not
/// writable.
Status write_beside(const std::filesystem::path& path,
                    const std::function<Status(const std::filesystem::path&)>& write);

/// Writes text or bytes.
Status write_file(const std::filesystem::path& path, std::string_view contents);

/// Writes a picture through OpenImageIO: .png (8 bits), .exr (16-bit float, linear), .jpg and others it knows. RGBA and
/// RGB images; alpha is dropped where the format has none.
Status write_image(const std::filesystem::path& path, const Image& image);

/// Writes a surface as .ply (ASCII) or .obj with nine significant digits, which give back every float.
/// positions and normals: one a vertex. indices: triangles.
Status write_surface(const std::filesystem::path& path, std::span<const Vec3> positions, std::span<const Vec3> normals,
                     std::span<const std::uint32_t> indices);

}  // namespace blush
