#pragma once
/// Wrinkles and blood in whole frames, against their exact twins drawn in the frame: the same face with the result
/// computed on the CPU, in double precision and texel by texel, as an ordinary texture.

#include <optional>
#include <span>

#include "rig/face.h"
#include "runtime/device.h"
#include "runtime/files/face_appearance.h"
#include "runtime/measure/study.h"

namespace blush {

/// The face in anger, 192 x 192 pixels, from the front. Errors are CIEDE2000 over all pixels. Nothing where the face
/// has no such maps beside its file, or its textures are laid out otherwise than by its first texture coordinates.
std::vector<Study> wrinkle_frame_study(const Device& device, const Face& face, double millimetres_a_unit);
std::vector<Study> blood_frame_study(const Device& device, const Face& face, double millimetres_a_unit);

/// The twins. `zone_weights`: of the set's zones. Every skin material gets a normal map that holds the wrinkles, or a
/// colour texture that holds the blood. Nothing where a material reads its map by other coordinates.
std::optional<Face> face_with_wrinkles(const Face& face, const std::vector<bool>& skin_material, const WrinkleSet& set,
                                       std::span<const float> zone_weights);
std::optional<Face> face_with_blood(const Face& face, const std::vector<bool>& skin_material,
                                    const SkinPigments& pigments, std::span<const std::string> map_names,
                                    std::span<const float> shares, float factor);

}  // namespace blush
