#pragma once

#include <array>
#include <optional>
#include <vector>

#include "graph/pass.h"
#include "passes/common/octree/octree_builder.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// How a ray finds the occupied voxels on its way. All find the same ones.
enum class VoxelTraversal {
    Bits,        ///< Voxel by voxel over the occupancy bits.
    Bricks,      ///< Bits by bricks of 4^3 voxels, and how far space is empty before each.
    SvoRestart,  ///< The octree, from its root down in each step (Sun and Agu 2015, figure 3).
    SvoVoxels,   ///< The same voxel by voxel, through empty ones too (Seok 2021, figure 12).
    Svo,         ///< The octree, from a level with distances on down.
};
template <>
struct EnumNames<VoxelTraversal> {
    static constexpr std::array names{
        std::pair{VoxelTraversal::Bits, "bits"}, std::pair{VoxelTraversal::Bricks, "bricks"},
        std::pair{VoxelTraversal::SvoRestart, "svo_restart"},
        std::pair{VoxelTraversal::SvoVoxels, "svo_voxels"}, std::pair{VoxelTraversal::Svo, "svo"}};
};

/// What rays walk through: surface voxels and what a walk needs besides, built of them. A shader that walks
/// is compiled with defines(), includes shaders/voxel_march/voxel_march.glsl and is given bindings(): it is
/// written once for all walks. A pass calls plan() in its own. Docs: docs/voxel-march.md.
class VoxelMarch {
 public:
    /// @param epsilon for SvoRestart: steps in floats, past each node by this many voxels, as in the
    /// paper, which skips what is thinner; 0 steps exactly.
    VoxelMarch(ProgramOwner& owner, VoxelTraversal walk, float epsilon = 0);

    /// Describes what a walk takes besides the voxels.
    /// @throws Error for a grid that it can't walk through.
    void plan(MemoryPlan& plan, const SurfaceVoxels& voxels);

    /// Takes over the voxels where their content is another one, and sets the counts to 0. `voxels` must
    /// outlive the walks. Waits for the device where it builds.
    void begin(CommandStream& stream, const SurfaceVoxels& voxels);

    Defines defines() const;
    /// Of all that shaders/voxel_march/voxel_march.glsl may use.
    std::vector<Binding> bindings() const;
    /// Steps and visits since begin(), 64 bits each (PassContext::voxelCounts).
    const Buffer& counts() const { return counts_; }

    uint64_t memoryBytes() const;

 private:
    /// Makes what shaders/voxel_march/distances.glsl tells of the voxels or of the octree.
    void measureDistances(CommandStream& stream);

    VoxelTraversal walk_;
    float epsilon_;
    std::optional<OctreeBuilder> builder_;  ///< Of walks through an octree.
    Kernel cells_;
    std::array<Kernel, 3> along_;  ///< The axes.
    const SurfaceVoxels* voxels_ = nullptr;
    std::optional<uint64_t> version_;  ///< Of the voxels that bricks or octree are built of.
    Octree octree_;
    Buffer bricks_, distances_;
    Buffer fewerAxes_;  ///< Distances along one axis or two, while those along all three are measured.
    Buffer counts_;
};

}  // namespace voxray
