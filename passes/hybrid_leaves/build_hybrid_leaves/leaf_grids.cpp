#include "passes/hybrid_leaves/build_hybrid_leaves/leaf_grids.h"

#include <span>

#include "base/error.h"
#include "passes/hybrid_leaves/build_hybrid_leaves/cell_layout.h"

namespace voxray {
namespace {

/// The buffer `hybridLeaves` of passes/hybrid_leaves/hybrid_leaves.glsl.
struct HybridHeader {
    VkDeviceAddress words, primitives, gridBits, gridRanks, cells, corners;
    gpu::HybridShape shape;
};

}  // namespace

void requireBelow(uint64_t count, uint64_t limit, const char* what) {
    if (count >= limit)
        throw Error(
            "build_hybrid_leaves: leaves need {} {}, of which {} are possible: "
            "lower voxelize's 'resolution', or change 'primitives' or 'grid'",
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

LeafGrids::LeafGrids(ProgramOwner& owner, CellWrite write, const PrefixSum& bitPrefixSum)
    : write_(write),
      bitPrefixSum_(bitPrefixSum),
      markCells_(owner, "mark_cells.comp"),
      writeCells_(owner, write == CellWrite::Average ? "accumulate_cells.comp" : "write_cells.comp"),
      averageCells_(owner, "average_cells.comp"),
      coarsenCells_(owner, "coarsen_cells.comp"),
      measureThickness_(owner, "measure_thickness.comp") {}

void LeafGrids::fill(PassContext& context, const gpu::VoxelGrid& voxels, const TriangleLeafPairs& pairs,
                     const LeafUpdateCache* updateCache, HybridLeaves& leaves) const {
    CommandStream& stream = context.stream;
    const uint32_t words = leaves.gridCount * leaves.shape.wordsPerGrid;
    leaves.gridBits = Buffer(context.device, "bits of grids", uintBytes(words));
    leaves.gridRanks = Buffer(context.device, "ranks of grids", uintBytes(words));
    stream.fill(leaves.gridBits, 0);
    writeHeader(stream, leaves);

    // A pair is a tile (voxelize_in_leaf.glsl)
    const Bindings pairBindings{context.scene,
                                leaves,
                                {"PairsRef", pairs.list.ref()},
                                {"grid", voxels},
                                {"fixedPointScale", pairs.unitsPerFace},
                                {"tiles", pairs.count},
                                {"axis", 0u},
                                {"samples", 0u}};

    // Mark cells, then rank them
    stream.dispatch(markCells_, pairs.count, pairBindings);
    if (updateCache) updateCache->copyGridBits(stream, leaves);
    leaves.cellCount = bitPrefixSum_.run(stream, leaves.gridBits, leaves.gridRanks, words);
    requireBelow(leaves.cellCount, kMaxGridCells, "cells of grids");
    leaves.cells =
        Buffer(context.device, "cells of grids", uintBytes(uint64_t(leaves.cellCount) * leaves.shape.cellWords));
    stream.fill(leaves.cells, 0);
    writeHeader(stream, leaves);

    // Values of cells, then their thickness
    LargeBuffer sums;
    if (write_ == CellWrite::Average) {
        sums = LargeBuffer(context.device, "sums of cells",
                           uintBytes(uint64_t(leaves.cellCount) * cellLayout(*context.frame.scene->scene).sumWords));
        stream.fill(sums, 0);
    }
    stream.dispatch(writeCells_, pairs.count, {pairBindings.all(), ifUsed({"CellSumsRef", sums.ref()})});
    if (sums) {
        stream.dispatch(averageCells_, leaves.cellCount,
                        {leaves, {"CellSumsRef", sums.ref()}, {"cells", leaves.cellCount}});
        const uint32_t cellsPerGrid = gridCells(leaves.shape.gridResolution, 1, leaves.shape.gridLevels);
        stream.dispatch(
            coarsenCells_, leaves.gridCount * cellsPerGrid,
            {leaves, {"CellSumsRef", sums.ref()}, {"grids", leaves.gridCount}, {"cellsPerGrid", cellsPerGrid}});
    }
    stream.dispatch(measureThickness_, pairs.count, pairBindings);
    if (updateCache) updateCache->copyCells(stream, leaves);
    stream.finish();
}

}  // namespace voxray
