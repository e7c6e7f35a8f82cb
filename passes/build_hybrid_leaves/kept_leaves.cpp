#include "passes/build_hybrid_leaves/kept_leaves.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"

namespace voxray {

/// As in kept_arrays.glsl.
struct KeptLeaves::Push {
    VkDeviceAddress words, primitives, gridBits, gridRanks, cells;
    uint32_t count;
};

KeptLeaves::KeptLeaves(Device& device, const ShaderCompiler& compiler) {
    const auto program = [&](const char* file) { return makeComputeProgram(device, compiler.compile(file)); };
    counts_ = program("passes/build_hybrid_leaves/keep_counts.comp");
    lists_ = program("passes/build_hybrid_leaves/keep_lists.comp");
    bits_ = program("passes/build_hybrid_leaves/keep_bits.comp");
    cells_ = program("passes/build_hybrid_leaves/keep_cells.comp");
}

void KeptLeaves::remember(CommandStream& stream, const SurfaceVoxels& numbered, Buffer counts) {
    previousCounts_ = std::move(counts);
    const auto copy = [&](Buffer& to, const Buffer& from, const char* name) {
        if (!to) to = Buffer(stream.device(), name, from.bytes());
        stream.copy(from, to, from.bytes());
    };
    copy(occupancy_, numbered.occupancy, "occupancy of the last leaves");
    copy(rank_, numbered.rank, "ranks of the last leaves");
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

KeptLeaves::Push KeptLeaves::push(uint32_t count) const {
    const auto address = [](const Buffer& buffer) { return buffer ? buffer.address() : VkDeviceAddress(0); };
    return {address(previous_.words),     address(previous_.primitives), address(previous_.gridBits),
            address(previous_.gridRanks), address(previous_.cells),      count};
}

uint32_t KeptLeaves::counts(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& counted,
                            const Buffer& counts) {
    keptFrom_ = Buffer(stream.device(), "numbers that leaves had", counts.bytes());
    const Buffer rebuilt(stream.device(), "leaves that are built again", sizeof(uint32_t));
    stream.fill(rebuilt, 0);
    const uint32_t words = uint32_t(voxels.words());
    stream.dispatch(counts_,
                    {{"region", region_},
                     {"voxelOccupancy", voxels.occupancy},
                     {"voxelRank", voxels.rank},
                     {"previous", occupancy_},
                     {"previousRank", rank_},
                     {"previousCounts", previousCounts_},
                     {"counted", counted},
                     {"counts", counts},
                     {"keptFrom", keptFrom_},
                     {"rebuilt", rebuilt}},
                    words, linearGroups(words));
    return stream.readAs<uint32_t>(rebuilt, 1)[0];
}

void KeptLeaves::lists(CommandStream& stream, const HybridLeaves& leaves, const Buffer& counts) {
    gridFrom_ =
        Buffer(stream.device(), "numbers that grids had", std::max(leaves.gridCount, 1u) * sizeof(uint32_t));
    stream.dispatch(lists_,
                    {{"keptFrom", keptFrom_},
                     {"counts", counts},
                     {"gridFrom", gridFrom_},
                     {"hybridLeaves", leaves.header}},
                    push(leaves.shape.leaves), linearGroups(leaves.shape.leaves));
}

void KeptLeaves::bits(CommandStream& stream, const HybridLeaves& leaves) const {
    const uint32_t words = leaves.gridCount * leaves.shape.wordsPerGrid;
    stream.dispatch(bits_, {{"gridFrom", gridFrom_}, {"hybridLeaves", leaves.header}}, push(words),
                    linearGroups(words));
}

void KeptLeaves::cells(CommandStream& stream, const HybridLeaves& leaves) const {
    const uint32_t words = leaves.gridCount * leaves.shape.wordsPerGrid;
    stream.dispatch(cells_, {{"gridFrom", gridFrom_}, {"hybridLeaves", leaves.header}}, push(words),
                    linearGroups(words));
}

void KeptLeaves::end() {
    previous_.release();
    region_ = {}, keptFrom_ = {}, gridFrom_ = {};
}

}  // namespace voxray
