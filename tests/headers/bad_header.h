#pragma once
// Not used: shows that check_includes.cmake finds what it looks for.
#include <epoxy/gl.h>

#include <vector>

#include "runtime/gl/object.h"

using Unlike = glm::vec3;
