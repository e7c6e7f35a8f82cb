#include "passes/hybrid_leaves/build_hybrid_leaves/kept_leaves.h"

#include <algorithm>
#include <utility>

namespace voxray {

KeptLeaves::KeptLeaves(ProgramOwner& owner)
    : counts_(owner, "keep_counts.comp"),
      lists_(owner, "keep_lists.comp"),
      bits_(owner, "keep_bits.comp"),
      cells_(owner, "keep_cells.comp") {}

void KeptLeaves::plan(MemoryPlan& plan, const SurfaceVoxels& voxels) {
    plan.buffer(occupancy_, "occupancy of the last leaves", voxels.words() * sizeof(uint32_t));
    plan.buffer(rank_, "ranks of the last leaves", voxels.words() * sizeof(uint32_t));
}

void KeptLeaves::remember(CommandStream& stream, const SurfaceVoxels& numbered, Buffer counts) {
    previousCounts_ = std::move(counts);
    stream.copy(numbered.occupancy, occupancy_, occupancy_.bytes());
    stream.copy(numbered.rank, rank_, rank_.bytes());
    stream.finish();
}

void KeptLeaves::begin(HybridLeaves& leaves, Buffer region) {
    for (Buffer HybridLeaves::*array :
         {&HybridLeaves::words, &HybridLeaves::primitives, &HybridLeaves::gridBits, &HybridLeaves::gridRanks,
          &HybridLeaves::cells})
        previous_.*array = std::move(leaves.*array);
    leaves.release();
    region_ = std::move(region);
}

std::vector<Binding> KeptLeaves::arrays(uint32_t count) const {
    const auto address = [](const Buffer& buffer) { return buffer ? buffer.address() : VkDeviceAddress(0); };
    return {{"words", address(previous_.words)},       {"primitives", address(previous_.primitives)},
            {"gridBits", address(previous_.gridBits)}, {"gridRanks", address(previous_.gridRanks)},
            {"cells", address(previous_.cells)},       {"count", count}};
}

uint32_t KeptLeaves::counts(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& counted,
                            const Buffer& counts) {
    keptFrom_ = Buffer(stream.device(), "numbers that leaves had", counts.bytes());
    const Buffer rebuilt(stream.device(), "leaves that are built again", sizeof(uint32_t));
    stream.fill(rebuilt, 0);
    const uint32_t words = uint32_t(voxels.words());
    stream.dispatch(counts_, words,
                    {voxels,
                     {"region", region_},
                     {"previous", occupancy_},
                     {"previousRank", rank_},
                     {"previousCounts", previousCounts_},
                     {"counted", counted},
                     {"counts", counts},
                     {"keptFrom", keptFrom_},
                     {"rebuilt", rebuilt},
                     {"words", words}});
    return stream.readAs<uint32_t>(rebuilt, 1)[0];
}

void KeptLeaves::lists(CommandStream& stream, const HybridLeaves& leaves, const Buffer& counts) {
    gridFrom_ =
        Buffer(stream.device(), "numbers that grids had", std::max(leaves.gridCount, 1u) * sizeof(uint32_t));
    stream.dispatch(lists_, leaves.shape.leaves,
                    {leaves,
                     {"keptFrom", keptFrom_},
                     {"counts", counts},
                     {"gridFrom", gridFrom_},
                     arrays(leaves.shape.leaves)});
}

void KeptLeaves::bits(CommandStream& stream, const HybridLeaves& leaves) const {
    const uint32_t words = leaves.gridCount * leaves.shape.wordsPerGrid;
    stream.dispatch(bits_, words, {leaves, {"gridFrom", gridFrom_}, arrays(words)});
}

void KeptLeaves::cells(CommandStream& stream, const HybridLeaves& leaves) const {
    const uint32_t words = leaves.gridCount * leaves.shape.wordsPerGrid;
    stream.dispatch(cells_, words, {leaves, {"gridFrom", gridFrom_}, arrays(words)});
}

void KeptLeaves::end() {
    previous_.release();
    region_ = {}, keptFrom_ = {}, gridFrom_ = {};
}

}  // namespace voxray
