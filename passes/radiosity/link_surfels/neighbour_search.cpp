#include "passes/radiosity/link_surfels/neighbour_search.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace voxray {
namespace {

constexpr uint64_t kPairBytes = 2 * sizeof(uint32_t);

/// Pairs on flat surfaces with that many points. A plane passes through at most sqrt(3) voxels per square of
/// their size, and a disk with a voxel's size as radius covers pi squares.
uint64_t pairsOnFlatSurfaces(uint64_t points, uint32_t voxels) {
    const double neighboursPerPoint = std::numbers::pi * std::numbers::sqrt3 * double(points) / std::max(voxels, 1u);
    return std::min(uint64_t(2 * double(points) * neighboursPerPoint) + 2 * points,
                    uint64_t(std::numeric_limits<uint32_t>::max()));
}

}  // namespace

NeighbourSearch::NeighbourSearch(ProgramOwner& owner)
    : count_(owner, "list_neighbours.comp", {{"COUNT", "1"}}),
      list_(owner, "list_neighbours.comp"),
      prefixSum_(owner, PrefixSum::Input::Uints) {}

float NeighbourSearch::run(CommandStream& stream, const SurfaceVoxels& voxels, uint64_t points,
                           const SurfelsByVoxel& surfels, SurfelNeighbours& neighbours) const {
    Device& device = stream.device();
    const uint32_t count = surfels.sortedCount;
    neighbours.begins = {}, neighbours.pairs = {};
    neighbours.begins = Buffer(device, "first neighbour of each surfel", (uint64_t(count) + 1) * sizeof(uint32_t));
    const uint64_t maxPairs = pairsOnFlatSurfaces(points, voxels.voxelCount);
    float radius = 1;
    uint64_t pairs = countPairs(stream, voxels, surfels, radius * voxels.grid.voxelSize, neighbours);
    while (pairs > maxPairs) {  // At radius 0 there are none.
        radius = radius > 0.01f ? kRadiusStep * radius : 0;
        pairs = countPairs(stream, voxels, surfels, radius * voxels.grid.voxelSize, neighbours);
    }
    neighbours.pairs = LargeBuffer(device, "neighbours of surfels", std::max<uint64_t>(pairs, 1) * kPairBytes);
    stream.dispatch(list_, count,
                    {voxels,
                     {"SortedRef", surfels.sorted.ref()},
                     {"surfelRanges", surfels.ranges},
                     {"begins", neighbours.begins},
                     {"PackedRef", surfels.packed.ref()},
                     {"PairsRef", neighbours.pairs.ref()},
                     {"count", count},
                     {"radius", radius * voxels.grid.voxelSize}});
    stream.finish();
    return radius;
}

uint64_t NeighbourSearch::countPairs(CommandStream& stream, const SurfaceVoxels& voxels, const SurfelsByVoxel& surfels,
                                     float radius, SurfelNeighbours& neighbours) const {
    const uint32_t count = surfels.sortedCount;
    const Buffer largest(stream.device(), "neighbours of a surfel, at most", sizeof(uint32_t));
    stream.fill(neighbours.begins, 0);
    stream.fill(largest, 0);
    stream.dispatch(count_, count,
                    {voxels,
                     {"SortedRef", surfels.sorted.ref()},
                     {"surfelRanges", surfels.ranges},
                     {"counts", neighbours.begins},
                     {"largest", largest},
                     {"count", count},
                     {"radius", radius}});
    const uint64_t upperBound = uint64_t(stream.readAs<uint32_t>(largest, 1)[0]) * count;
    const uint32_t sum = prefixSum_.run(stream, neighbours.begins, neighbours.begins, count + 1);
    return upperBound > std::numeric_limits<uint32_t>::max() ? upperBound : sum;
}

}  // namespace voxray
