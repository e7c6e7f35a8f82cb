#pragma once

#include <array>
#include <optional>
#include <vector>

#include "graph/pass.h"
#include "passes/common/octree/octree_builder.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Data structures that rays traverse to find occupied voxels. All find the same ones.
enum class VoxelTraversal {
    Bits,        ///< Voxel by voxel over the occupancy bits.
    Bricks,      ///< Bricks of 4^3 bits, with the distances to the next occupied brick.
    SvoRestart,  ///< The octree, from its root in each step (Sun and Agu 2015, figure 3).
    SvoVoxels,   ///< The same voxel by voxel, through empty space as well (Seok 2021, figure 12).
    Svo,         ///< The octree, from a level with distances down.
};
template <>
struct EnumNames<VoxelTraversal> {
    static constexpr std::array names{
        std::pair{VoxelTraversal::Bits, "bits"}, std::pair{VoxelTraversal::Bricks, "bricks"},
        std::pair{VoxelTraversal::SvoRestart, "svo_restart"}, std::pair{VoxelTraversal::SvoVoxels, "svo_voxels"},
        std::pair{VoxelTraversal::Svo, "svo"}};
};

/// Surface voxels with the data structure of a traversal, for shaders that trace rays through them. Such a
/// shader includes shaders/voxel_march/voxel_march.glsl, is compiled with defines() and given bindings(), for
/// any traversal. A pass calls plan() from its own. Docs: docs/voxel-march.md.
class VoxelMarch {
 public:
    /// @param epsilon of SvoRestart, in voxels: above 0 steps are in floats, past each node by epsilon, as in
    /// the paper; shorter segments in voxels are skipped. 0: exact steps.
    VoxelMarch(ProgramOwner& owner, VoxelTraversal traversal, float epsilon = 0);

    /// Describes the memory of the data structure. @throws Error for a grid of more than 1024 voxels along an
    /// axis or a window.
    void plan(MemoryPlan& plan, const SurfaceVoxels& voxels);

    /// Sets the voxels, which must outlive the rays, and resets the counts. Where the voxels have changed it
    /// builds the data structure, and waits for the device.
    void begin(CommandStream& stream, const SurfaceVoxels& voxels);

    Defines defines() const;
    /// For shaders/voxel_march/voxel_march.glsl.
    std::vector<Binding> bindings() const;
    /// Steps and visits since begin(), 64 bits each (PassContext::marchCounters).
    const Buffer& counts() const { return counts_; }

    uint64_t memoryBytes() const;

 private:
    /// Computes the distances of shaders/voxel_march/distances.glsl, and the bricks.
    void measureDistances(CommandStream& stream);

    VoxelTraversal traversal_;
    float epsilon_;
    std::optional<OctreeBuilder> builder_;  ///< Of the octree.
    Kernel cells_;
    std::array<Kernel, 3> along_;  ///< By axis.
    const SurfaceVoxels* voxels_ = nullptr;
    std::optional<uint64_t> version_;  ///< Of the voxels that the data structure is built from.
    Octree octree_;
    Buffer bricks_, distances_;
    Buffer fewerAxes_;  ///< Distances along one axis or two, while those along all three are computed.
    Buffer counts_;
};

}  // namespace voxray
