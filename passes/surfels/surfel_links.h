#pragma once

#include <limits>

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"

namespace voxray {

/// Which surfels each surfel sees: rays from it, distributed by cosine, each linked to the surfel that stands
/// for where it hit. The irradiance that arrives by one bounce is the mean over a surfel's links of what the
/// linked surfels reflect: irradiance times reflectance (Goral et al. 1984, with form factors by counting
/// rays). Depends on geometry and materials alone, not on light.
struct SurfelLinks : Resource {
    std::string indexedBy() const override { return "surfels"; }

    static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();  ///< A ray that met nothing.

    uint32_t raysPerSurfel = 0;
    uint32_t surfelCount = 0;  ///< Of all chunks of Surfels; numbered through, chunk by chunk.
    /// Number of a linked surfel, or kNone: that of ray r from surfel i at r * surfelCount + i.
    LargeBuffer links;
};

}  // namespace voxray
