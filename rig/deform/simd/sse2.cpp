#include "rig/deform/simd/kernels.h"

#if BLUSH_X86
#include "rig/deform/simd/pack4.h"

namespace blush::simd {

const Kernels sse2_kernels = kernels_of<Pack4, Pack4>();

}  // namespace blush::simd
#endif
