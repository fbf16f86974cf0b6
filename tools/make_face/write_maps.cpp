#include "tools/make_face/write_maps.h"

#include "rig/head/canonical_face.h"
#include "runtime/files/appearance_file.h"
#include "runtime/files/face_file.h"
#include "tools/blush/new_folder.h"

namespace blush::make_face {

Status write_maps(const std::filesystem::path& folder, const AppearanceMaps& pigments,
                  const std::filesystem::path& face_path, const std::filesystem::path& pattern_folder) {
    const Result<std::vector<HemoglobinPattern>> patterns = load_hemoglobin_patterns(pattern_folder);
    if (!patterns) return patterns.error();
    const Result<Face> face = load_face(face_path);
    if (!face) return face.error();
    const std::vector<std::uint32_t> skin = skin_primitives(*face);
    const std::optional<FaceLandmarks> landmarks = landmarks_from_targets(*face, skin);
    if (!landmarks) return Error{face->path + ": eyes and mouth cannot be found by its targets"};
    constexpr std::uint32_t side = HemoglobinMapOptions{}.side;
    const std::optional<CanonicalMap> canonical = canonical_map(*face, skin, CanonicalFrame(*landmarks), side, side);
    if (!canonical) return Error{face->path + ": its skin has no texture coordinates that span a texture"};
    tool::NewFolder made;
    if (Status s = made.make(folder); !s) return s;
    if (Status s = write_appearance(folder, pigments); !s) return s;
    return write_hemoglobin_maps(folder, hemoglobin_maps(pigments, *canonical, *patterns));
}

}  // namespace blush::make_face
