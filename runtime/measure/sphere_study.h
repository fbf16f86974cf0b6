#pragma once
/// A study on a white sphere: the one shape on which every pixel's normal is
/// known, so that a whole picture has an exact twin on the CPU.

#include <functional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "runtime/device.h"
#include "runtime/lighting.h"
#include "runtime/measure/study.h"

namespace blush {

struct SphereVariant {
    std::string setting, value;
    bool is_default = false;
    /// What a pixel shows, in double precision: of a unit normal, seen from +Z.
    std::function<glm::dvec3(glm::dvec3 normal)> exact;
};

/// One study: a sphere of white skin without scattering, shadows or
/// translucency, 96x96 pixels, seen from afar. Errors are over every third
/// pixel and row within 0.97 of its radius, in hundredths of the exact
/// picture's mean.
std::vector<Study> sphere_study(const Device& device, const std::string& name, const std::string& reference,
                                const Lighting& lighting, const std::vector<SphereVariant>& variants);

/// Roughness m of the sphere's skin.
inline constexpr double sphere_roughness = 0.3;

}  // namespace blush
