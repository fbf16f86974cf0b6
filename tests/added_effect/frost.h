#pragma once

#include "runtime/frame/effect.h"

namespace blush {

extern const Effect frost_effect;

}  // namespace blush
