#include "rig/deform/simd/kernel_body.h"

namespace blush::simd {

const Kernels scalar_kernels = kernels_of<Pack1, Pack1>();

}  // namespace blush::simd
