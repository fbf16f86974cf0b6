#include "runtime/files/output_file.h"

#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <system_error>

namespace blush {
namespace fs = std::filesystem;

Status write_beside(const fs::path& path, const std::function<Status(const fs::path&)>& write) {
    std::error_code failed;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, failed)) {
        return Error{path.string() + ": cannot be written: the folder " + folder.string() + " does not exist"};
    }
    if (fs::is_directory(path, failed)) return Error{path.string() + ": cannot be written: it is a folder"};
    if (::access(folder.c_str(), W_OK) != 0) {
        return Error{path.string() + ": cannot be written: no permission in the folder " + folder.string()};
    }
    // The ending is kept, since writers choose the format by it; the process number keeps two runs apart.
    const fs::path beside = folder / (".blush-" + std::to_string(::getpid()) + "-" + path.filename().string());
    Status written = write(beside);
    if (written) {
        fs::rename(beside, path, failed);
        if (failed) written = Error{path.string() + ": cannot be written: " + failed.message()};
    }
    if (!written) fs::remove(beside, failed);
    return written;
}

Status write_file(const fs::path& path, std::string_view contents) {
    return write_beside(path, [&](const fs::path& beside) -> Status {
        std::ofstream file(beside, std::ios::binary);
        file.write(contents.data(), static_cast<std::streamsize>(contents.size()));
        file.close();
        if (!file) return Error{path.string() + ": cannot be written: the disk refused it"};
        return Done{};
    });
}

Status write_image(const fs::path& path, const Image& image) {
    const auto output = OIIO::ImageOutput::create(path.string());
    if (!output) {
        return Error{path.string() + ": no picture format is known by the ending \"" + path.extension().string() +
                     "\""};
    }
    return write_beside(path, [&](const fs::path& beside) -> Status {
        const bool bytes = !image.bytes.empty();
        const bool drop_alpha = image.channels == 4 && output->supports("alpha") == 0;
        const int channels = drop_alpha ? 3 : static_cast<int>(image.channels);
        OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), channels,
                             bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::HALF);
        spec.attribute("oiio:ColorSpace", bytes ? "sRGB" : "Linear");
        // Without these two, the same picture written twice would differ.
        spec.attribute("DateTime", "");
        spec.attribute("Software", "blush");
        const auto refused = [&] { return Error{path.string() + ": cannot be written: " + output->geterror()}; };
        if (!output->open(beside.string(), spec)) return refused();
        const OIIO::stride_t pixel_bytes = static_cast<OIIO::stride_t>(image.channels * (bytes ? 1 : sizeof(float)));
        const bool written = bytes ? output->write_image(OIIO::TypeDesc::UINT8, image.bytes.data(), pixel_bytes)
                                   : output->write_image(OIIO::TypeDesc::FLOAT, image.floats.data(), pixel_bytes);
        if (!written || !output->close()) return refused();
        return Done{};
    });
}

namespace {

template <class... Numbers>
void append(std::string& text, const char* format, Numbers... numbers) {
    std::array<char, 128> line{};
    const int length = std::snprintf(line.data(), line.size(), format, numbers...);
    text.append(line.data(), static_cast<std::size_t>(length));
}

double d(float value) { return static_cast<double>(value); }

std::string ply_of(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                   std::span<const std::uint32_t> indices) {
    std::string text = "ply\nformat ascii 1.0\n";
    append(text, "element vertex %zu\n", positions.size());
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) append(text, "property float %s\n", name);
    append(text, "element face %zu\nproperty list uchar uint vertex_indices\nend_header\n", indices.size() / 3);
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const glm::vec3 p = positions[v], n = normals[v];
        append(text, "%.9g %.9g %.9g %.9g %.9g %.9g\n", d(p.x), d(p.y), d(p.z), d(n.x), d(n.y), d(n.z));
    }
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        append(text, "3 %u %u %u\n", indices[i], indices[i + 1], indices[i + 2]);
    }
    return text;
}

std::string obj_of(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                   std::span<const std::uint32_t> indices) {
    std::string text;
    for (const glm::vec3 p : positions) append(text, "v %.9g %.9g %.9g\n", d(p.x), d(p.y), d(p.z));
    for (const glm::vec3 n : normals) append(text, "vn %.9g %.9g %.9g\n", d(n.x), d(n.y), d(n.z));
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::uint32_t a = indices[i] + 1, b = indices[i + 1] + 1, c = indices[i + 2] + 1;
        append(text, "f %u//%u %u//%u %u//%u\n", a, a, b, b, c, c);
    }
    return text;
}

}  // namespace

Status write_surface(const fs::path& path, std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                     std::span<const std::uint32_t> indices) {
    if (path.extension() == ".ply") return write_file(path, ply_of(positions, normals, indices));
    if (path.extension() == ".obj") return write_file(path, obj_of(positions, normals, indices));
    return Error{path.string() + ": a surface is written as .ply or .obj"};
}

}  // namespace blush
