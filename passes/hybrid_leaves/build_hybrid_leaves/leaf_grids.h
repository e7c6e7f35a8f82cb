#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "base/schema.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/compute/prefix_sum.h"
#include "passes/common/compute/uint_bytes.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_sums.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/leaf_update_cache.h"

namespace voxray {

/// How a cell's value follows from its surfaces.
enum class CellWrite { Average, None };
template <>
struct EnumNames<CellWrite> {
    static constexpr std::array names{std::pair{CellWrite::Average, "average"}, std::pair{CellWrite::None, "none"}};
};

constexpr uint64_t kMaxGridCells = (1ull << 32) / EXTENDED_SUM_UINTS;  // Indices have 32 bits.

/// @throws Error where `count` reaches the limit.
void requireBelow(uint64_t count, uint64_t limit, const char* what);

uint64_t hybridHeaderBytes();
/// Writes the arrays' addresses for shaders.
void writeHeader(CommandStream& stream, HybridLeaves& leaves);

/// Builds the grids of finer voxels, the cells, of leaves with many triangles.
class LeafGrids {
 public:
    /// @param bitPrefixSum of set bits; must outlive this object.
    LeafGrids(ProgramOwner& owner, CellWrite write, const PrefixSum& bitPrefixSum);

    /// Pairs of a triangle and a leaf.
    struct TriangleLeafPairs {
        const LargeBuffer& list;  ///< As in voxelize_in_leaf.glsl.
        uint32_t count;
        float unitsPerFace;  ///< Fixed-point units of area per cell face.
    };
    /// Voxelizes the triangles of pairs into cells. Waits for the device. @param voxels the grid of leaves.
    /// @param updateCache in an update; null where all is built.
    void fill(PassContext& context, const gpu::VoxelGrid& voxels, const TriangleLeafPairs& pairs,
              const LeafUpdateCache* updateCache, HybridLeaves& leaves) const;

 private:
    CellWrite write_;
    const PrefixSum& bitPrefixSum_;
    Kernel markCells_, writeCells_, averageCells_, coarsenCells_, measureThickness_;
};

}  // namespace voxray
