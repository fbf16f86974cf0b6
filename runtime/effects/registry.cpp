#include <array>

#include "runtime/effect.h"

namespace blush {

std::span<const Effect* const> effects() {
    static const std::array<const Effect*, 8> all = {&deformation_effect, &normals_effect,      &skinning_effect,
                                                     &shadows_effect,     &translucency_effect, &reflection_effect,
                                                     &environment_effect, &scattering_effect};
    return all;
}

}  // namespace blush
