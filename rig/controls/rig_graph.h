#pragma once
/// What depends on what in a description, and which of its shapes names alone tell.

#include <vector>

#include "rig/controls/control_order.h"
#include "rig/controls/control_table.h"
#include "rig/controls/rig_description.h"

namespace blush {

/// Drives, correctives and limits as dependences between controls.
std::vector<Dependence> dependences_of(const RigDescription& description, const ControlTable& table);

}  // namespace blush
