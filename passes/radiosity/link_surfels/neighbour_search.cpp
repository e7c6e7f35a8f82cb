#include "passes/radiosity/link_surfels/neighbour_search.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace voxray {
namespace {

constexpr uint64_t kPairBytes = 2 * sizeof(uint32_t);

/// Pairs on flat surfaces with so many points. A plane cuts through up to the root of 3 voxels for each
/// square of their size, and a disk whose radius is a voxel's size is pi of these.
uint64_t pairsOnPlanes(uint64_t points, uint32_t voxels) {
    const double around = std::numbers::pi * std::numbers::sqrt3 * double(points) / std::max(voxels, 1u);
    return std::min(uint64_t(2 * double(points) * around) + 2 * points,
                    uint64_t(std::numeric_limits<uint32_t>::max()));
}

}  // namespace

NeighbourSearch::NeighbourSearch(ProgramOwner& owner)
    : count_(owner, "neighbours.comp", {{"COUNT", "1"}}),
      list_(owner, "neighbours.comp"),
      prefixSum_(owner, PrefixSum::Of::Values) {}

float NeighbourSearch::run(CommandStream& stream, const SurfaceVoxels& voxels, uint64_t points,
                           const SurfelsByVoxel& surfels, SurfelNeighbours& to) const {
    Device& device = stream.device();
    const uint32_t slots = surfels.slotCount;
    to.begins = {}, to.pairs = {};
    to.begins = Buffer(device, "first neighbour of each surfel", (uint64_t(slots) + 1) * sizeof(uint32_t));
    const uint64_t most = pairsOnPlanes(points, voxels.voxelCount);
    float radius = 1;
    uint64_t pairs = count(stream, voxels, surfels, radius * voxels.grid.voxelSize, to);
    while (pairs > most) {  // At radius 0 there are none.
        radius = radius > 0.01f ? kShrink * radius : 0;
        pairs = count(stream, voxels, surfels, radius * voxels.grid.voxelSize, to);
    }
    to.pairs = LargeBuffer(device, "neighbours of surfels", std::max<uint64_t>(pairs, 1) * kPairBytes);
    stream.dispatch(list_, slots,
                    {voxels,
                     {"SortedAt", surfels.sorted.at()},
                     {"lists", surfels.lists},
                     {"begins", to.begins},
                     {"PackedAt", surfels.packed.at()},
                     {"PairsAt", to.pairs.at()},
                     {"slots", slots},
                     {"radius", radius * voxels.grid.voxelSize}});
    stream.finish();
    return radius;
}

uint64_t NeighbourSearch::count(CommandStream& stream, const SurfaceVoxels& voxels,
                                const SurfelsByVoxel& surfels, float radius, SurfelNeighbours& to) const {
    const uint32_t slots = surfels.slotCount;
    const Buffer largest(stream.device(), "neighbours of a surfel, at most", sizeof(uint32_t));
    stream.fill(to.begins, 0);
    stream.fill(largest, 0);
    stream.dispatch(count_, slots,
                    {voxels,
                     {"SortedAt", surfels.sorted.at()},
                     {"lists", surfels.lists},
                     {"counts", to.begins},
                     {"largest", largest},
                     {"slots", slots},
                     {"radius", radius}});
    const uint64_t bound = uint64_t(stream.readAs<uint32_t>(largest, 1)[0]) * slots;
    const uint32_t sum = prefixSum_.run(stream, to.begins, to.begins, slots + 1);
    return bound > std::numeric_limits<uint32_t>::max() ? bound : sum;
}

}  // namespace voxray
