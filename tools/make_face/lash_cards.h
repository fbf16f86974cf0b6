#pragma once
/// Lashes as curved cards that hang on the lids' edges.

#include "tools/make_face/eyes.h"

namespace blush::make_face {

Lashes make_lash_cards(const Head& head);

}  // namespace blush::make_face
