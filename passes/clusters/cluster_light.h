#pragma once

#include <algorithm>
#include <vector>

#include "graph/pass.h"
#include "passes/clusters/cluster_visibility.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Radiosity (W/m²) of cluster components and patches, the targets of ClusterVisibility. It is packed into 32
/// bits with an error of at most 1/255 of the largest channel (passes/surfels/radiosity.glsl). It contains
/// reflected light only, not the emission of surfaces.
struct ClusterLight : Resource {
    Buffer components;    ///< 1 for each component face.
    LargeBuffer patches;  ///< 1 for each patch.
    LargeBuffer direct;   ///< Direct irradiance (W/m²) of each patch, packed likewise.

    /// Size of a buffer of `count` packed values, at least one.
    static uint64_t bytes(uint64_t count) { return std::max<uint64_t>(count, 1) * sizeof(uint32_t); }
};

/// The bindings of passes/clusters/gather_patch.glsl.
inline std::vector<Binding> gatherBindings(const ClusterVisibility& visibility, const ClusterLight& light) {
    return {{"visibilityLists", visibility.chunkAddresses},
            {"componentRadiosity", light.components},
            {"PatchRadiosityRef", light.patches.ref()}};
}

}  // namespace voxray
