#pragma once

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "graph/pass.h"
#include "passes/clusters/cluster_visibility.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// What parts of clusters and patches send: radiosity (W/m²) by the targets of ClusterVisibility, in 32 bits
/// each, off by 1/255 of the largest channel at most (passes/surfels/radiosity.glsl). Light that lamps send
/// themselves is not in it.
struct ClusterLight : Resource {
    Buffer parts;         ///< 6 a part.
    LargeBuffer patches;  ///< 1 a patch.
    LargeBuffer direct;   ///< Irradiance (W/m²) straight from the lights, packed likewise: 1 a patch.

    /// Bytes of one of these values for each of so many.
    static uint64_t bytes(uint64_t count) { return std::max<uint64_t>(count, 1) * sizeof(uint32_t); }
};

/// What passes/clusters/gather_patch.glsl reads.
std::vector<Binding> gatherBindings(const ClusterVisibility& visibility, const ClusterLight& light);

/// Radiosity of what patches see, weighted by their rays: the irradiance of each patch.
class ClusterGather {
 public:
    explicit ClusterGather(ProgramOwner& owner) : gather_(owner, "cluster_gather.comp") {}

    /// @param irradiance 1 value a patch, W/m², packed as ClusterLight is.
    void gather(CommandStream& stream, const ClusterVisibility& visibility, const ClusterLight& light,
                const LargeBuffer& irradiance) const;

 private:
    Kernel gather_;
};

}  // namespace voxray
