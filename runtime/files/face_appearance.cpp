#include "runtime/files/face_appearance.h"

#include "runtime/files/appearance_file.h"

namespace blush {
namespace fs = std::filesystem;

fs::path appearance_folder(const fs::path& face) {
    fs::path folder = face;
    folder.replace_extension(".appearance");
    return folder;
}

Result<FaceAppearance> load_face_appearance(const fs::path& folder) {
    FaceAppearance appearance;
    std::error_code failed;
    if (fs::exists(folder / "wrinkles.json", failed)) {
        Result<WrinkleSet> wrinkles = load_wrinkles(folder);
        if (!wrinkles) return wrinkles.error();
        appearance.wrinkles = *std::move(wrinkles);
    }
    if (fs::exists(folder / "melanin.png", failed)) {
        Result<AppearanceMaps> maps = load_appearance(folder);
        if (!maps) return maps.error();
        Result<HemoglobinMaps> blood = load_hemoglobin_maps(folder);
        if (!blood) return blood.error();
        appearance.pigments = SkinPigments{*std::move(maps), *std::move(blood)};
    }
    return appearance;
}

}  // namespace blush
