#pragma once
/// Public heads as one glTF file each: what their authors publish in, what load_face() reads out.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "rig/result.h"

namespace blush {

struct ImportedHead {
    std::string glb;  ///< the whole file
    std::size_t vertices = 0, triangles = 0, targets = 0;
    std::vector<std::string> notes;  ///< what was left out or is missing, one sentence each
};

/// USC ICT-FaceKit: a folder (or an archive of one) that holds generic_neutral_mesh.obj and one OBJ file an
/// expression, as its public repository has them in FaceXModel/. Identity shapes are left out, with a note.
///
/// Positions are the files' numbers in single precision, in centimetres; the root node scales them to glTF's metres. A
/// target is the difference of the decimals, rounded once; what is below 1e-6 cm (the spacing of floats at a head's
/// size) counts as none. Names become ARKit's (eyeBlink_L is eyeBlinkLeft); ICT's halves of browInnerUp and cheekPuff
/// stay halves, as in browInnerUpLeft.
Result<ImportedHead> import_ict(const std::filesystem::path& folder_or_archive);

/// MakeHuman: a folder (or an archive of one) that holds base.obj and, anywhere below, .target files in folders called
/// faceunits and visemes, and the parts high-poly (eyes), teeth_base, tongue01 and eyelashes01 (.mhclo with .obj) with
/// their textures. The base mesh is cut above the collarbones. What is missing is noted.
///
/// Positions are the files' numbers in single precision, in decimetres; parts are fitted to the base mesh in double
/// precision, at rest and at each target.
struct MakeHumanOptions {
    std::vector<std::string> shapes;  ///< "caucasian-male-young" or "caucasian-male-young=0.8": .target files by name
};
Result<ImportedHead> import_makehuman(const std::filesystem::path& folder_or_archive,
                                      const MakeHumanOptions& options = {});

}  // namespace blush
