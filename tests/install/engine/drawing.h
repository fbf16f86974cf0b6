#pragma once
/// A small face, drawn through the installed library.

#include "rig/face.h"
#include "runtime/device.h"

/// 64 x 64 pixels of a pyramid that is turned, with its tip lifted half way by a target.
blush::Result<blush::Image> draw_pyramid(const blush::Device& device);
