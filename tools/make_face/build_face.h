#pragma once
/// The default face, put together.

#include "tools/make_face/person.h"
#include "tools/make_face/write_glb.h"

namespace blush::make_face {

/// `vertices`: of the head's skin, roughly; from 5,000 to 1,000,000. The same number and person give the same face.
FaceParts build_face(std::size_t vertices, const Person& person = {});

}  // namespace blush::make_face
