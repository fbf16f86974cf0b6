#pragma once
/// MLAA or SMAA 1x over one picture, with the two middle steps, on the CPU or on the GPU.

#include "rig/antialias/pixels.h"
#include "rig/antialias/settings.h"
#include "rig/result.h"
#include "runtime/device.h"

namespace blush {

enum class SpatialFilter : std::uint8_t { mlaa, smaa1x };

struct FilterRequest {
    SpatialFilter filter = SpatialFilter::smaa1x;
    MlaaSettings mlaa;
    SmaaSettings smaa;
    PictureMeaning meaning;
    bool eight_bits = true;  ///< the picture has 8 bits a channel; else it is filtered in single precision on the GPU

    const EdgeSettings& edges() const { return filter == SpatialFilter::mlaa ? mlaa.edges : smaa.edges; }
};

struct FilteredPicture {
    Pixels picture;
    EdgeMap edges;
    WeightMap weights;
};

/// depth: as find_edges() has it.
FilteredPicture filter_on_cpu(const Pixels& picture, const DepthPixels& depth, const FilterRequest& request);

/// Error: a picture larger than the device's textures, or a driver that does not compile the shaders.
Result<FilteredPicture> filter_on_gpu(const Device& device, const Pixels& picture, const DepthPixels& depth,
                                      const FilterRequest& request);

}  // namespace blush
