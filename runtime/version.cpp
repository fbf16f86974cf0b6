#include "runtime/version.h"

namespace blush {

Version version() { return {}; }

}  // namespace blush
