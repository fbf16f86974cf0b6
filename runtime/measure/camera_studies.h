#pragma once
/// What the camera's effects cost, and how far they are from their twins in double precision.

#include "runtime/frame/effect.h"

namespace blush {

std::vector<Study> bloom_studies(const Device& device, const Face& face, double millimetres_a_unit, bool quick);
std::vector<Study> exposure_studies(const Device& device, const Face& face, double millimetres_a_unit, bool quick);
std::vector<Study> film_grain_studies(const Device& device, const Face& face, double millimetres_a_unit, bool quick);
/// Beside a real lens: the mean of pictures from many places of its opening (Haeberli and Akeley 1990).
std::vector<Study> depth_of_field_studies(const Device& device, const Face& face, double millimetres_a_unit,
                                          bool quick);

}  // namespace blush
