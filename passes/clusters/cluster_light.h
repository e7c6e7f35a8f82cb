#pragma once

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "graph/pass.h"
#include "passes/clusters/cluster_visibility.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Radiosity (W/m²) of cluster components and patches, the targets of ClusterVisibility. 32 bits each: off by
/// 1/255 of the largest channel at most (passes/surfels/radiosity.glsl). Reflected light only: what emissive
/// surfaces send themselves is not in it.
struct ClusterLight : Resource {
    Buffer components;    ///< 6 a component: one for each face.
    LargeBuffer patches;  ///< 1 a patch.
    LargeBuffer direct;   ///< Irradiance (W/m²) straight from the lights, packed likewise: 1 a patch.

    /// Size of a buffer of `count` packed values.
    static uint64_t bytes(uint64_t count) { return std::max<uint64_t>(count, 1) * sizeof(uint32_t); }
};

/// What passes/clusters/gather_patch.glsl reads.
std::vector<Binding> gatherBindings(const ClusterVisibility& visibility, const ClusterLight& light);

/// Irradiance of all patches: the mean radiosity that their rays met.
class ClusterGather {
 public:
    explicit ClusterGather(ProgramOwner& owner) : gather_(owner, "gather_patches.comp") {}

    /// @param irradiance 1 value a patch, W/m², packed as in ClusterLight.
    void gather(CommandStream& stream, const ClusterVisibility& visibility, const ClusterLight& light,
                const LargeBuffer& irradiance) const;

 private:
    Kernel gather_;
};

}  // namespace voxray
