#include <algorithm>
#include <exception>
#include <new>
#include <string>

#include "runtime/files/bad_file.h"
#include "runtime/files/bytes.h"
#include "runtime/files/face_file.h"
#include "runtime/files/gltf/gltf_container.h"
#include "runtime/files/gltf/gltf_face.h"
#include "runtime/files/obj/obj_file.h"

namespace blush {
namespace {

std::string lower_case_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return extension;
}

[[noreturn]] void refuse_kind() { load::refuse("", "not a face file (expected .glb, .gltf or .obj)"); }

Face read_face(const std::filesystem::path& path, const LoadLimits& limits) {
    const std::string extension = lower_case_extension(path);
    const load::Bytes file = load::read_file(path, limits.file_bytes, "");
    if (file.empty()) load::refuse("", "not a face file: it is empty (expected .glb, .gltf or .obj)");
    if (extension == ".glb" || extension == ".gltf") {
        if (!load::looks_like_gltf(file))
            load::refuse("", "not a face file: it is named " + extension + ", but its content is neither GLB nor JSON");
        return load::read_gltf(file, path, limits);
    }
    if (extension == ".obj" && load::is_glb(file)) load::refuse("", "it is named .obj, but its content is GLB");
    if (extension == ".obj") return load::read_obj(file, limits);
    // A face under another name is known by the GLB magic alone: many files are JSON or text.
    if (load::is_glb(file)) return load::read_gltf(file, path, limits);
    refuse_kind();
}

}  // namespace

Result<Face> load_face(const std::filesystem::path& path, const LoadLimits& limits) {
    const std::string name = path.string();
    try {
        Face face = read_face(path, limits);
        face.path = name;
        if (Status status = validate(face); !status) return status.error();
        return face;
    } catch (const load::BadFile& bad) {
        return Error{name + ": " + (bad.place.empty() ? "" : bad.place + ": ") + bad.reason};
    } catch (const std::bad_alloc&) {
        return Error{name + ": there is not enough memory to load this file"};
    } catch (const std::exception& error) {
        return Error{name + ": the file cannot be read (" + error.what() + ")"};
    }
}

}  // namespace blush
