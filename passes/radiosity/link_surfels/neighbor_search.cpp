#include "passes/radiosity/link_surfels/neighbor_search.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace voxray {
namespace {

constexpr uint64_t kPairBytes = 2 * sizeof(uint32_t);

/// Pairs on flat surfaces with that many points. A plane passes through at most sqrt(3) voxels per square of
/// their size, and a disk with a voxel's size as radius covers pi squares.
uint64_t pairsOnFlatSurfaces(uint64_t points, uint32_t voxels) {
    const double neighborsPerPoint = std::numbers::pi * std::numbers::sqrt3 * double(points) / std::max(voxels, 1u);
    return std::min(uint64_t(2 * double(points) * neighborsPerPoint) + 2 * points,
                    uint64_t(std::numeric_limits<uint32_t>::max()));
}

}  // namespace

NeighborSearch::NeighborSearch(ProgramOwner& owner)
    : count_(owner, "list_neighbors.comp", {{"COUNT", "1"}}),
      list_(owner, "list_neighbors.comp"),
      prefixSum_(owner, PrefixSum::Input::Uints) {}

float NeighborSearch::run(CommandStream& stream, const SurfaceVoxels& voxels, uint64_t points,
                          const SurfelsByVoxel& surfels, SurfelNeighbors& neighbors) const {
    Device& device = stream.device();
    const uint32_t count = surfels.sortedCount;
    neighbors.begins = {}, neighbors.pairs = {};
    neighbors.begins = Buffer(device, "first neighbor of each surfel", (uint64_t(count) + 1) * sizeof(uint32_t));
    const uint64_t maxPairs = pairsOnFlatSurfaces(points, voxels.voxelCount);
    float radius = 1;
    uint64_t pairs = countPairs(stream, voxels, surfels, radius * voxels.grid.voxelSize, neighbors);
    while (pairs > maxPairs) {  // At radius 0 there are none.
        radius = radius > 0.01f ? kRadiusStep * radius : 0;
        pairs = countPairs(stream, voxels, surfels, radius * voxels.grid.voxelSize, neighbors);
    }
    neighbors.pairs = LargeBuffer(device, "neighbors of surfels", std::max<uint64_t>(pairs, 1) * kPairBytes);
    stream.dispatch(list_, count,
                    {voxels,
                     {"SortedRef", surfels.sorted.ref()},
                     {"surfelRanges", surfels.ranges},
                     {"begins", neighbors.begins},
                     {"PackedRef", surfels.packed.ref()},
                     {"PairsRef", neighbors.pairs.ref()},
                     {"count", count},
                     {"radius", radius * voxels.grid.voxelSize}});
    stream.finish();
    return radius;
}

uint64_t NeighborSearch::countPairs(CommandStream& stream, const SurfaceVoxels& voxels, const SurfelsByVoxel& surfels,
                                    float radius, SurfelNeighbors& neighbors) const {
    const uint32_t count = surfels.sortedCount;
    const Buffer largest(stream.device(), "neighbors of a surfel, at most", sizeof(uint32_t));
    stream.fill(neighbors.begins, 0);
    stream.fill(largest, 0);
    stream.dispatch(count_, count,
                    {voxels,
                     {"SortedRef", surfels.sorted.ref()},
                     {"surfelRanges", surfels.ranges},
                     {"counts", neighbors.begins},
                     {"largest", largest},
                     {"count", count},
                     {"radius", radius}});
    const uint64_t upperBound = uint64_t(stream.readAs<uint32_t>(largest, 1)[0]) * count;
    const uint32_t sum = prefixSum_.run(stream, neighbors.begins, neighbors.begins, count + 1);
    return upperBound > std::numeric_limits<uint32_t>::max() ? upperBound : sum;
}

}  // namespace voxray
