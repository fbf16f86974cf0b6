#include "runtime/files/wrinkle_bake.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rig/wrinkles/fold_layout.h"
#include "rig/wrinkles/texture_bytes.h"
#include "rig/wrinkles/wrinkle_sources.h"

namespace blush {
namespace {

/// By the distance of its pupils, as the eyelids' targets tell it; 0 where they do not.
double millimetres_of(const std::optional<FaceLandmarks>& landmarks) {
    if (!landmarks) return 0;
    const auto apart = static_cast<double>(glm::distance(landmarks->left_eye, landmarks->right_eye));
    return apart > 0 ? 2 * static_cast<double>(canonical_pupil_mm) / apart : 0;
}

}  // namespace

Result<BakedWrinkles> bake_wrinkle_set(const Face& face, const WrinkleBakeOptions& options) {
    const std::vector<std::uint32_t> skin = skin_primitives(face);
    if (skin.empty()) {
        return Error{face.path +
                     ": no targets like eyeBlinkLeft and mouthSmileLeft move one part of it, so that its "
                     "skin cannot be told from the rest"};
    }
    std::vector<std::uint8_t> wanted(face.primitives.size(), 0);
    for (const std::uint32_t primitive : skin) wanted[primitive] = 1;

    BakedWrinkles baked;
    const std::optional<FaceLandmarks> landmarks = landmarks_from_targets(face, skin);
    baked.millimetres_a_unit = options.millimetres_a_unit > 0 ? options.millimetres_a_unit : millimetres_of(landmarks);
    if (baked.millimetres_a_unit <= 0)
        return Error{face.path + ": its scale cannot be told; name it with --millimetres-per-unit"};
    WrinkleBake settings = options.maps;
    settings.millimetres_a_unit = static_cast<float>(baked.millimetres_a_unit);

    const RigDescription description = default_description(face);
    const Rig rig(face, description);
    const std::vector<WrinkleSource> sources = wrinkle_sources(rig, description);
    baked.poses = sources.size();
    if (sources.empty()) return Error{face.path + ": none of its expressions wrinkles a zone"};
    WrinkleSet& set = baked.set;
    set.zones.assign(rig.wrinkle_zones().begin(), rig.wrinkle_zones().end());
    if (set.zones.size() > most_wrinkle_zones) {
        return Error{face.path + ": its rig has " + std::to_string(set.zones.size()) +
                     " wrinkle zones; the masks hold " + std::to_string(most_wrinkle_zones)};
    }
    std::vector<WrinkleZoneField> places;
    std::optional<Face> part;
    if (landmarks) {
        const CanonicalFrame frame(*landmarks);
        const std::vector<std::uint8_t> outer = outer_triangles(face, skin, frame);
        if (!options.whole_layout) set.part = part_of_zones(face, outer, frame, set.zones);
        part = cropped(face, outer, set.part);
        if (const auto map = canonical_map(*part, skin, frame, settings.map_side, settings.map_side))
            places = wrinkle_zone_fields(set.zones, *map);
    }
    WrinkleMaps maps = bake_wrinkles(part ? *part : face, wanted, sources, settings, places);
    baked.displacement_mm = std::move(maps.displacement_mm);
    baked.overlapping_texels = maps.raster.overlaps;
    set.masks = std::move(maps.masks);
    set.derivatives = std::move(maps.derivatives);

    float steepest = 0, largest = 0;
    for (const glm::vec2 derivative : set.derivatives.values) {
        steepest = std::max(steepest, glm::length(derivative));
        largest = std::max({largest, std::abs(derivative.x), std::abs(derivative.y)});
    }
    baked.steepest_degrees = std::atan(static_cast<double>(steepest)) * 180 / std::numbers::pi;
    set.range =
        options.range > 0 ? options.range : std::clamp(largest, published_derivative_range, widest_chosen_range);
    for (glm::vec2& derivative : set.derivatives.values) {
        const glm::vec2 held = glm::clamp(derivative, glm::vec2(-set.range), glm::vec2(set.range));
        if (held != derivative) ++baked.saturated_texels;
        derivative = held;
    }
    for (std::size_t zone = 0; zone < set.zones.size(); ++zone) {
        if (std::ranges::all_of(set.masks[zone].values, [](float value) { return value == 0; }))
            baked.empty_zones.push_back(set.zones[zone]);
    }
    return baked;
}

WrinkleBytes wrinkle_bytes(const WrinkleSet& set) {
    const std::uint32_t width = set.derivatives.width, height = set.derivatives.height;
    WrinkleBytes bytes;
    bytes.map = rgtc2_bytes(width, height);
    bytes.mip_levels = with_mip_levels(width, height, rgtc2_bytes) - bytes.map;
    bytes.uncompressed_map = std::uint64_t{2} * width * height;
    bytes.masks = 4 * wrinkle_masks_for(set.masks.size()) * set.masks[0].values.size();
    return bytes;
}

}  // namespace blush
