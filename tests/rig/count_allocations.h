#pragma once
/// Counts what this test program allocates.

#include <cstddef>

namespace blush::test {

/// Calls of operator new since the program began.
std::size_t allocation_count();

}  // namespace blush::test
