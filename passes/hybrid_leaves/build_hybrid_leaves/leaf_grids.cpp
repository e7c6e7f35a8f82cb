#include "passes/hybrid_leaves/build_hybrid_leaves/leaf_grids.h"

#include <span>

#include "base/error.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_size.h"

namespace voxray {
namespace {

/// The buffer `hybridLeaves` of passes/hybrid_leaves/hybrid_leaves.glsl.
struct HybridHeader {
    VkDeviceAddress words, primitives, gridBits, gridRanks, cells, corners;
    gpu::HybridShape shape;
};

}  // namespace

void requireLeaves(uint64_t count, uint64_t limit, const char* what) {
    if (count >= limit)
        throw Error(
            "build_hybrid_leaves: leaves need {} {}, of which {} are possible: lower voxelize's "
            "'resolution', or change 'primitives' or 'grid'",
            count, what, limit - 1);
}

uint64_t hybridHeaderBytes() {
    return sizeof(HybridHeader);
}

void writeHeader(CommandStream& stream, HybridLeaves& leaves) {
    const auto address = [](const Buffer& buffer) { return buffer ? buffer.address() : VkDeviceAddress(0); };
    const HybridHeader header{address(leaves.words),
                              address(leaves.primitives),
                              address(leaves.gridBits),
                              address(leaves.gridRanks),
                              address(leaves.cells),
                              address(leaves.corners),
                              leaves.shape};
    stream.upload(leaves.header, std::as_bytes(std::span(&header, 1)));
}

LeafGrids::LeafGrids(ProgramOwner& owner, CellWrite write, const PrefixSum& sumBits)
    : write_(write),
      sumBits_(sumBits),
      mark_(owner, "mark_cells.comp"),
      writeCells_(owner, write == CellWrite::Average ? "add_cells.comp" : "write_cells.comp"),
      resolve_(owner, "resolve_cells.comp"),
      coarsen_(owner, "coarsen_cells.comp"),
      enclose_(owner, "enclose_cells.comp") {}

void LeafGrids::fill(PassContext& context, const gpu::VoxelGrid& voxels, const Pairs& pairs,
                     const KeptLeaves* kept, HybridLeaves& leaves) const {
    CommandStream& stream = context.stream;
    const uint32_t words = leaves.gridCount * leaves.shape.wordsPerGrid;
    leaves.gridBits = Buffer(context.device, "bits of grids", wordBytes(words));
    leaves.gridRanks = Buffer(context.device, "ranks of grids", wordBytes(words));
    stream.fill(leaves.gridBits, 0);
    writeHeader(stream, leaves);

    // Each pair is a tile (grid_cells.glsl).
    const Bindings ofPairs{context.scene,
                           leaves,
                           {"PairsAt", pairs.list.at()},
                           {"grid", voxels},
                           {"visitorScale", pairs.cellUnit},
                           {"tiles", pairs.count},
                           {"axis", 0u},
                           {"samples", 0u},
                           {"imageSide", 0u}};

    // Mark their cells, then number them.
    stream.dispatch(mark_, pairs.count, ofPairs);
    if (kept) kept->bits(stream, leaves);
    leaves.cellCount = sumBits_.run(stream, leaves.gridBits, leaves.gridRanks, words);
    requireLeaves(leaves.cellCount, kMaxGridCells, "cells of grids");
    leaves.cells = Buffer(context.device, "cells of grids",
                          wordBytes(uint64_t(leaves.cellCount) * leaves.shape.cellWords));
    stream.fill(leaves.cells, 0);
    writeHeader(stream, leaves);

    // What they hold, and how far from their planes.
    LargeBuffer sums;
    if (write_ == CellWrite::Average) {
        sums =
            LargeBuffer(context.device, "sums of cells",
                        wordBytes(uint64_t(leaves.cellCount) * cellSize(*context.frame.scene->scene).sums));
        stream.fill(sums, 0);
    }
    stream.dispatch(writeCells_, pairs.count, {ofPairs.all(), ifUsed({"CellSumsAt", sums.at()})});
    if (sums) {
        stream.dispatch(resolve_, leaves.cellCount,
                        {leaves, {"CellSumsAt", sums.at()}, {"cells", leaves.cellCount}});
        const uint32_t cellsPerGrid = gridCells(leaves.shape.gridResolution, 1, leaves.shape.gridLevels);
        stream.dispatch(
            coarsen_, leaves.gridCount * cellsPerGrid,
            {leaves, {"CellSumsAt", sums.at()}, {"grids", leaves.gridCount}, {"cellsPerGrid", cellsPerGrid}});
    }
    stream.dispatch(enclose_, pairs.count, ofPairs);
    if (kept) kept->cells(stream, leaves);
    stream.finish();
}

}  // namespace voxray
