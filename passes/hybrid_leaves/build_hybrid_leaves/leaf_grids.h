#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "base/schema.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/compute/prefix_sum.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_sums.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/kept_leaves.h"

namespace voxray {

/// How the surfaces in a cell become its value.
enum class CellWrite { Average, None };
template <>
struct EnumNames<CellWrite> {
    static constexpr std::array names{std::pair{CellWrite::Average, "average"},
                                      std::pair{CellWrite::None, "none"}};
};

constexpr uint64_t kMaxGridCells = (1ull << 32) / BRIGHT_SUM_UINTS;  // cell_sums.h, by 32 bits.

/// Bytes of so many words, or of one.
inline uint64_t wordBytes(uint64_t count) {
    return std::max<uint64_t>(count, 1) * sizeof(uint32_t);
}

/// @throws Error for a count of the limit or more.
void requireLeaves(uint64_t count, uint64_t limit, const char* what);

uint64_t hybridHeaderBytes();
/// Leads shaders to the arrays of hybrid leaves as they are now.
void writeHeader(CommandStream& stream, HybridLeaves& leaves);

/// The grids of finer voxels, cells, in leaves where triangles are many.
class LeafGrids {
 public:
    /// @param sumBits of set bits; it must outlive the grids.
    LeafGrids(ProgramOwner& owner, CellWrite write, const PrefixSum& sumBits);

    /// Pairs of a triangle and a leaf.
    struct Pairs {
        const LargeBuffer& list;  ///< As in grid_cells.glsl.
        uint32_t count;
        float cellUnit;  ///< Units of area for a cell's face.
    };
    /// Voxelizes the triangles of pairs into cells. Waits for the device. @param voxels the grid of leaves.
    /// @param kept what an update takes over; null where all is built.
    void fill(PassContext& context, const gpu::VoxelGrid& voxels, const Pairs& pairs, const KeptLeaves* kept,
              HybridLeaves& leaves) const;

 private:
    CellWrite write_;
    const PrefixSum& sumBits_;
    Kernel mark_, writeCells_, resolve_, coarsen_, enclose_;
};

}  // namespace voxray
