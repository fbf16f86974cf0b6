#pragma once
/// How large a face is, in millimetres: files seldom say.

#include <string_view>

#include "rig/face.h"

namespace blush {

struct FaceScale {
    double millimetres_a_unit = 1;  ///< of the world; finite and above 0
    std::string_view told_by;       ///< a clause: "its pupils are taken as 62 mm apart"
    bool is_guess = true;           ///< from what the shape of its bounds is like
};

/// In this order: a largest extent of 0.15 to 0.6 is a head in metres, glTF's
/// unit. The lids' targets tell where the pupils are, 62 mm apart (Farkas
/// 1994). What is nearly as wide as tall, or wider, has shoulders, 450 mm of
/// them (the bideltoid breadth of adults, 390 to 490 mm: Gordon et al. 1989; a
/// bust ends a little inside of it). Anything else is a head of 240 mm. The
/// first node that draws the skin stands for the whole where nodes are scaled.
FaceScale face_scale(const Face& face);

}  // namespace blush
