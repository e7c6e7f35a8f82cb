#include "passes/hybrid_leaves/build_hybrid_leaves/leaf_update_cache.h"

#include <algorithm>
#include <utility>

namespace voxray {

LeafUpdateCache::LeafUpdateCache(ProgramOwner& owner)
    : mergeCounts_(owner, "merge_counts.comp"),
      copyLists_(owner, "copy_lists.comp"),
      copyGridBits_(owner, "copy_grid_bits.comp"),
      copyCells_(owner, "copy_cells.comp") {}

void LeafUpdateCache::plan(MemoryPlan& plan, const SurfaceVoxels& voxels) {
    plan.buffer(occupancy_, "occupancy of the last leaves", voxels.words() * sizeof(uint32_t));
    plan.buffer(rank_, "ranks of the last leaves", voxels.words() * sizeof(uint32_t));
}

void LeafUpdateCache::store(CommandStream& stream, const SurfaceVoxels& voxels, Buffer counts) {
    previousCounts_ = std::move(counts);
    stream.copy(voxels.occupancy, occupancy_, occupancy_.bytes());
    stream.copy(voxels.rank, rank_, rank_.bytes());
    stream.finish();
}

void LeafUpdateCache::beginUpdate(HybridLeaves& leaves, Buffer region) {
    for (Buffer HybridLeaves::*member : {&HybridLeaves::words, &HybridLeaves::primitives, &HybridLeaves::gridBits,
                                         &HybridLeaves::gridRanks, &HybridLeaves::cells})
        previous_.*member = std::move(leaves.*member);
    leaves.release();
    region_ = std::move(region);
}

std::vector<Binding> LeafUpdateCache::previousArrays(uint32_t count) const {
    const auto address = [](const Buffer& buffer) { return buffer ? buffer.address() : VkDeviceAddress(0); };
    return {{"words", address(previous_.words)},       {"primitives", address(previous_.primitives)},
            {"gridBits", address(previous_.gridBits)}, {"gridRanks", address(previous_.gridRanks)},
            {"cells", address(previous_.cells)},       {"count", count}};
}

uint32_t LeafUpdateCache::mergeCounts(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& rebuiltCounts,
                                      const Buffer& counts) {
    previousLeaf_ = Buffer(stream.device(), "numbers that leaves had", counts.bytes());
    const Buffer rebuiltLeaves(stream.device(), "leaves that are built again", sizeof(uint32_t));
    stream.fill(rebuiltLeaves, 0);
    const uint32_t words = uint32_t(voxels.words());
    stream.dispatch(mergeCounts_, words,
                    {voxels,
                     {"region", region_},
                     {"previousOccupancy", occupancy_},
                     {"previousRank", rank_},
                     {"previousCounts", previousCounts_},
                     {"rebuiltCounts", rebuiltCounts},
                     {"counts", counts},
                     {"previousLeaf", previousLeaf_},
                     {"rebuiltLeaves", rebuiltLeaves},
                     {"words", words}});
    return stream.readAs<uint32_t>(rebuiltLeaves, 1)[0];
}

void LeafUpdateCache::copyLists(CommandStream& stream, const HybridLeaves& leaves, const Buffer& counts) {
    previousGrid_ =
        Buffer(stream.device(), "numbers that grids had", std::max(leaves.gridCount, 1u) * sizeof(uint32_t));
    stream.dispatch(copyLists_, leaves.shape.leaves,
                    {leaves,
                     {"previousLeaf", previousLeaf_},
                     {"counts", counts},
                     {"previousGrid", previousGrid_},
                     previousArrays(leaves.shape.leaves)});
}

void LeafUpdateCache::copyGridBits(CommandStream& stream, const HybridLeaves& leaves) const {
    const uint32_t words = leaves.gridCount * leaves.shape.wordsPerGrid;
    stream.dispatch(copyGridBits_, words, {leaves, {"previousGrid", previousGrid_}, previousArrays(words)});
}

void LeafUpdateCache::copyCells(CommandStream& stream, const HybridLeaves& leaves) const {
    const uint32_t words = leaves.gridCount * leaves.shape.wordsPerGrid;
    stream.dispatch(copyCells_, words, {leaves, {"previousGrid", previousGrid_}, previousArrays(words)});
}

void LeafUpdateCache::endUpdate() {
    previous_.release();
    region_ = {}, previousLeaf_ = {}, previousGrid_ = {};
}

}  // namespace voxray
