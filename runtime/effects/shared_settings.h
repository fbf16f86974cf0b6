#pragma once
/// Settings that others read than the file of the effect that has them. Each is defined there.

#include "runtime/settings.h"

namespace blush {

extern const SettingId antialiasing_mode, supersampling_factor, velocities_source;
extern const SettingId shadows_method, shadows_size, shadows_edges;
extern const SettingId wrinkles_encoding, wrinkles_storage, blood_colour, blood_table_nodes;

}  // namespace blush
