#include <array>

#include "runtime/effect.h"

namespace blush {

std::span<const Effect* const> effects() {
    static const std::array<const Effect*, 3> all = {&deformation_effect, &normals_effect, &skinning_effect};
    return all;
}

}  // namespace blush
