#pragma once

#include <limits>

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"

namespace voxray {

/// Cosine-distributed rays from each surfel, each linked to the surfel that stands for its hit. A surfel's
/// irradiance after one more bounce is the mean radiosity of the linked surfels (Goral et al. 1984, with form
/// factors by counting rays). Does not depend on light.
struct SurfelLinks : Resource {
    std::string indexedBy() const override { return "surfels"; }

    static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();  ///< A ray without a surfel.

    uint32_t raysPerSurfel = 0;
    uint32_t surfelCount = 0;  ///< Of all chunks of Surfels.
    /// Index of the linked surfel among all chunks, kNone or LINK_NOT_TRACED: of ray r from surfel i at r * surfelCount
    /// + i.
    LargeBuffer links;
};

}  // namespace voxray
