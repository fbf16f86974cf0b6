/// Wrinkle maps as they are stored and added, and in whole frames.

#include <algorithm>

#include "rig/wrinkles/wrinkle_error.h"
#include "runtime/appearance/signed_texture.h"
#include "runtime/gl/state_guard.h"
#include "runtime/measure/appearance_frames.h"
#include "runtime/measure/appearance_probe.h"
#include "runtime/measure/studies.h"

namespace blush {
namespace {

/// The face's base normal map as derivatives, against the vectors of its image.
std::optional<Study> base_map_study(const Face& face, const std::shared_ptr<AppearanceProbe>& probe) {
    const auto material = std::ranges::find_if(face.materials, [](const Material& m) { return m.normal.image >= 0; });
    if (material == face.materials.end()) return std::nullopt;
    const auto image = std::make_shared<const Image>(face.images[static_cast<std::size_t>(material->normal.image)]);
    Study study{"base normal map of the face, " + std::to_string(image->width) + " texels wide",
                "the vectors of its image",
                "degrees",
                {},
                probe};
    constexpr std::array<std::pair<const char*, GLenum>, 3> formats = {
        {{"RGTC2, 1 byte a texel", GL_COMPRESSED_SIGNED_RG_RGTC2},
         {"2 bytes a texel", GL_RG8_SNORM},
         {"half floats, 4 bytes a texel", GL_RG16F}}};
    for (const auto& [name, format] : formats) {
        Variant variant;
        variant.label = name;
        variant.work = "made and read back";
        variant.is_default = study.variants.empty();
        variant.run = [image, probe, format = format] {
            const gl::StateGuard guard;
            (void)base_normal_error(*image, format);
        };
        variant.error = [image, probe, format = format] {
            const gl::StateGuard guard;
            const BaseNormalError error = base_normal_error(*image, format);
            return Variant::Error{error.mean, error.worst};
        };
        study.variants.push_back(std::move(variant));
    }
    return study;
}

}  // namespace

std::vector<Study> studies::wrinkles(const Device& device, const Face& face, double millimetres_a_unit,
                                     bool /*quick*/) {
    std::vector<Study> result = wrinkle_frame_study(device, face, millimetres_a_unit);
    Result<FaceAppearance> appearance = load_face_appearance(appearance_folder(face.path));
    if (!appearance || !appearance->wrinkles) return result;
    appearance->wrinkles->part = {};  // a texel of the map for a point of the probe
    std::shared_ptr<AppearanceProbe> probe = AppearanceProbe::create(device, face, *std::move(appearance));
    if (!probe) return result;

    Study stored{"stored wrinkle map of the face, every zone at 0.7",
                 "the map in single precision on the CPU",
                 "degrees",
                 {},
                 probe};
    for (const std::string_view storage : {"compressed", "plain", "half_float"}) {
        Variant variant;
        variant.label = "wrinkles.storage=" + std::string(storage);
        variant.is_default = storage == "compressed";
        const auto choose = [probe, storage] { (void)probe->character().set("wrinkles.storage", storage); };
        choose();
        variant.work = std::to_string(wrinkle_textures(probe->state()).bytes) + " bytes with mip levels and masks";
        variant.run = [probe, choose] {
            choose();
            probe->draw_normals(0.7F);
        };
        variant.error = [probe, choose] {
            choose();
            return probe->normal_error(0.7F);
        };
        stored.variants.push_back(std::move(variant));
    }
    result.push_back(std::move(stored));

    Study combined{"normals of folds of 45 degrees on pores, at half weight, in 8 bits",
                   "a displaced patch of skin in double precision (rig/wrinkles/wrinkle_error.h)",
                   "degrees",
                   {},
                   probe};
    for (const WrinkleEncoding encoding : {WrinkleEncoding::derivatives, WrinkleEncoding::differences}) {
        const bool derivatives = encoding == WrinkleEncoding::derivatives;
        const std::string_view choice = derivatives ? "derivatives" : "differences";
        Variant variant;
        variant.label = "wrinkles.encoding=" + std::string(choice);
        variant.is_default = derivatives;
        variant.work = derivatives ? "2 channels" : "3 channels";
        variant.run = [probe, choice] {
            (void)probe->character().set("wrinkles.encoding", choice);
            probe->draw_normals(0.5F);
        };
        variant.error = [encoding] {
            WrinkleErrorCase of;
            of.encoding = encoding;
            of.steepest_degrees = 45;
            of.weight = 0.5;
            const NormalError error = wrinkle_normal_error(of);
            return Variant::Error{error.mean_degrees, error.worst_degrees};
        };
        combined.variants.push_back(std::move(variant));
    }
    result.push_back(std::move(combined));
    if (std::optional<Study> base = base_map_study(face, probe)) result.push_back(*std::move(base));
    return result;
}

}  // namespace blush
