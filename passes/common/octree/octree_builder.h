#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/octree/octree.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Builds the structure of a sparse octree over surface voxels, from the root down (Crassin et al. 2011;
/// Arnebäck 2017, section 3.2.2): flag the voxels of each level that are not empty, count them, allocate,
/// then subdivide and number level by level. A node's number depends on its place alone: the same voxels give
/// the same bits.
class OctreeBuilder {
 public:
    OctreeBuilder(Device& device, const ShaderCompiler& compiler);

    struct Built {
        OctreeSize size;
        Buffer leaves;  ///< The voxel of each leaf, 10 bits for each coordinate.
    };
    /// Gives `radiance`, whose grid is set, the structure over `voxels`; values are left undefined. Waits for
    /// the device. @throws Error over the memory limit, with the bytes needed, before it allocates the
    /// octree.
    Built build(CommandStream& stream, const SurfaceVoxels& voxels, RadianceVoxels& radiance) const;

    /// Values of all inner nodes whose children's have changed. `changed`: a bit a node (changedBytes()), set
    /// for leaves with a new value, or for all nodes; the nodes that get a new value are set.
    void filter(CommandStream& stream, const OctreeSize& size, const RadianceVoxels& radiance,
                const Buffer& changed) const;
    static uint64_t changedBytes(const OctreeSize& size) {
        return (uint64_t(size.nodeCount()) + 31) / 32 * sizeof(uint32_t);
    }

    /// Bytes that build() takes for a while besides what it returns.
    static uint64_t scratchBytes(const OctreeSize& size);

 private:
    /// The flags of each level above the leaves; sets size.nodes.
    std::vector<Buffer> flag(CommandStream& stream, const SurfaceVoxels& voxels, OctreeSize& size) const;

    Program flag_, subdivide_, number_, filter_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
