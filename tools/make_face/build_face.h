#pragma once
/// The default face, put together.

#include "tools/make_face/person.h"
#include "tools/make_face/write_glb.h"

namespace blush::make_face {

/// 0.2 mm of the face a texel: pores are a few texels wide.
inline constexpr int default_texture_side = 1536;

/// `vertices`: of the head's skin, roughly; from 5,000 to 1,000,000. `texture_side`: texels of a side of the skin's
/// maps. The same numbers and person give the same face.
FaceParts build_face(std::size_t vertices, const Person& person = {}, int texture_side = default_texture_side);

}  // namespace blush::make_face
