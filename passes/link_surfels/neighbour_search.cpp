#include "passes/link_surfels/neighbour_search.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

constexpr uint64_t kPairBytes = 2 * sizeof(uint32_t);

struct NeighbourPush {
    gpu::VoxelGrid grid;
    uint32_t slots;
};

}  // namespace

void NeighbourSearch::plan(PassPlan& plan, const SurfelsByVoxel& surfels, uint64_t voxels) {
    // A disk whose radius is a voxel's size, on a flat surface; at most half of the surfels look to one side.
    const double around =
        std::numbers::pi / 2 * double(surfels.maxCount) / double(std::max<uint64_t>(voxels, 1));
    plan.reserve(
        "neighbours of surfels (estimated)",
        surfels.maxCount * sizeof(uint32_t) + uint64_t(double(surfels.maxCount) * around) * kPairBytes);
    plan.reserveScratch("counts of neighbours (estimated)",
                        PrefixSum::scratchBytes(uint32_t(surfels.maxCount + 1)));
}

void NeighbourSearch::prepare(PassSetup& setup) {
    const char* const file = "passes/link_surfels/neighbours.comp";
    count_ = makeComputeProgram(setup.device, setup.compiler.compile(file, {{"COUNT", "1"}}));
    list_ = makeComputeProgram(setup.device, setup.compiler.compile(file));
    prefixSum_.emplace(setup.device, setup.compiler, PrefixSum::Of::Values);
}

void NeighbourSearch::run(CommandStream& stream, const SurfaceVoxels& voxels, const SurfelsByVoxel& surfels,
                          SurfelNeighbours& to) const {
    Device& device = stream.device();
    const uint32_t slots = surfels.slotCount;
    to.begins = {}, to.pairs = {};
    to.begins = Buffer(device, "first neighbour of each surfel", (uint64_t(slots) + 1) * sizeof(uint32_t));
    const Buffer largest(device, "neighbours of a surfel, at most", sizeof(uint32_t));
    stream.fill(to.begins, 0);
    stream.fill(largest, 0);
    const NeighbourPush push{voxels.grid, slots};
    std::vector<Binding> bindings =
        voxels.bindings({{"SortedAt", surfels.sorted.at()}, {"lists", surfels.lists}});
    const auto dispatch = [&](const Program& program, std::vector<Binding> more) {
        more.insert(more.begin(), bindings.begin(), bindings.end());
        stream.dispatch(program, more, push, linearGroups(slots));
    };
    dispatch(count_, {{"counts", to.begins}, {"largest", largest}});
    const uint64_t most = stream.readAs<uint32_t>(largest, 1)[0];
    if (most * slots > std::numeric_limits<uint32_t>::max())
        throw Error(
            "link_surfels: {} surfels with up to {} neighbours each are more pairs than can be numbered "
            "(2^32); lower place_surfels's 'points_per_voxel', or leave smooth_surfels out",
            slots, most);
    const uint32_t pairs = prefixSum_->run(stream, to.begins, to.begins, slots + 1);
    to.pairs = LargeBuffer(device, "neighbours of surfels", std::max(pairs, 1u) * kPairBytes);
    dispatch(list_, {{"begins", to.begins}, {"PairsAt", to.pairs.at()}});
    stream.finish();
}

}  // namespace voxray
