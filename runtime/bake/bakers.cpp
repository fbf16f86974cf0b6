#include <array>

#include "runtime/bake/baker.h"

namespace blush {

std::span<const Baker* const> bakers() {
    static constexpr std::array all = {&wrinkle_baker, &appearance_baker};
    return all;
}

}  // namespace blush
