#pragma once
/// Whether a PNG is whole, before a decoder sees it: libpng tells standard error about damage, and OpenImageIO 2.4
/// leaks a string when libpng runs out of bytes.

#include <string>

#include "runtime/files/bytes.h"

namespace blush::load {

/// Walks the chunks up to IEND and compares their checksums (PNG, third edition, 5.3 and annex D). Throws BadFile.
void check_png(ByteView encoded, const std::string& place);

}  // namespace blush::load
