#include "runtime/load/obj_file.h"

#include "runtime/load/bad_file.h"

namespace blush::load {

Face read_obj(ByteView, const LoadLimits&) { refuse("", "OBJ files cannot be read yet"); }

}  // namespace blush::load
