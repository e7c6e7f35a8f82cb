#pragma once

#include "graph/pass.h"
#include "passes/common/clusters/cluster_visibility.h"
#include "passes/common/clusters/voxel_patches.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// What parts of clusters and sides of voxels send: radiosity (W/m²) by the targets of ClusterVisibility.
/// Light that lamps send themselves is not in it.
struct ClusterLight : Resource {
    Buffer parts;          ///< 6 x 3 floats a part.
    LargeBuffer sides;     ///< 6 x 3 floats a side.
    LargeBuffer direct;    ///< Irradiance (W/m²) straight from the lights, 6 x 3 floats a side.
    uint64_t version = 0;  ///< Another one whenever the light is.

    std::vector<const Buffer*> checkedBuffers() const override { return {&parts, &sides, &direct}; }
};

/// Radiosity of what faces see, weighted by their rays: the irradiance (W/m²) of each face.
class ClusterGather {
 public:
    ClusterGather() = default;
    ClusterGather(Device& device, const ShaderCompiler& compiler);

    /// Bytes of the irradiance that gather() writes.
    static uint64_t bytes(uint64_t sides) { return sides * kFaces * sizeof(glm::vec3); }
    /// @param irradiance 6 x 3 floats a side, W/m²; faces without a list are left as they are.
    void gather(CommandStream& stream, const ClusterVisibility& visibility, const ClusterLight& light,
                const LargeBuffer& irradiance) const;

 private:
    Program gather_;
};

}  // namespace voxray
