#pragma once
/// The default face, put together.

#include "tools/make_face/write_glb.h"

namespace blush::make_face {

/// `vertices`: of the head's skin, roughly; from 6,000 to 30,000. The same number gives the same face.
FaceParts build_face(std::size_t vertices);

}  // namespace blush::make_face
