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

/// Places of pairs, with some for lists that grow where surfaces move.
uint64_t placesOf(uint64_t pairs, bool moves) {
    return moves ? std::min<uint64_t>(pairs + pairs / 8 + (1u << 16), std::numeric_limits<uint32_t>::max()) : pairs;
}

}  // namespace

NeighborSearch::NeighborSearch(ProgramOwner& owner)
    : count_(owner, "count_neighbors.comp"),
      list_(owner, "list_neighbors.comp"),
      listChanged_(owner, "list_changed_surfels.comp"),
      update_(owner, "update_neighbors.comp"),
      prefixSum_(owner, PrefixSum::Input::Uints) {}

void NeighborSearch::plan(SurfelNeighbors& neighbors, bool moves) {
    moves_ = neighbors.areBySurfel = moves;
    for (Kernel* kernel : {&listChanged_, &update_}) kernel->compileIf(moves);
    if (!moves) return;
    for (Kernel* kernel : {&count_, &list_}) kernel->define({{"BY_SURFEL", "1"}});
}

void NeighborSearch::run(CommandStream& stream, const SurfaceVoxels& voxels, const Surfels& surfels,
                         const SurfelsByVoxel& byVoxel, SurfelNeighbors& neighbors) {
    Device& device = stream.device();
    const uint32_t nodes = neighbors.nodeCount = moves_ ? uint32_t(surfels.count) : byVoxel.sortedCount;
    neighbors.ranges = {}, neighbors.pairs = {};
    neighbors.ranges = Buffer(device, "neighbors of each surfel", std::max<uint64_t>(nodes, 1) * 2 * sizeof(uint32_t));
    stream.fill(neighbors.ranges, 0);
    const Buffer begins(device, "first neighbor of each surfel", std::max<uint64_t>(nodes, 1) * sizeof(uint32_t));
    const uint64_t maxPairs = pairsOnFlatSurfaces(surfels.pointCount, voxels.voxelCount);
    neighbors.radius = 1;
    uint64_t pairs = countPairs(stream, voxels, byVoxel, neighbors, begins);
    while (pairs > maxPairs) {  // At radius 0 there are none.
        neighbors.radius = neighbors.radius > 0.01f ? kRadiusStep * neighbors.radius : 0;
        pairs = countPairs(stream, voxels, byVoxel, neighbors, begins);
    }
    if (nodes > 0) prefixSum_.run(stream, begins, begins, nodes);
    neighbors.pairs =
        LargeBuffer(device, "neighbors of surfels", std::max<uint64_t>(placesOf(pairs, moves_), 1) * kPairBytes);
    if (moves_) {
        ensureSize(places_, device, "places of neighbors", begins.bytes());
        stream.fill(places_, 0);
        ensureSize(used_, device, "numbers of neighbors", 2 * sizeof(uint32_t));
        stream.upload(used_, std::vector<uint32_t>(2, uint32_t(pairs)));
    }
    stream.dispatch(list_, byVoxel.sortedCount,
                    {voxels,
                     {"SortedRef", byVoxel.sorted.ref()},
                     {"surfelRanges", byVoxel.ranges},
                     {"begins", begins},
                     {"ranges", neighbors.ranges},
                     ifUsed({"places", places_}),
                     {"PairsRef", neighbors.pairs.ref()},
                     {"count", byVoxel.sortedCount},
                     {"radius", neighbors.radius * voxels.grid.voxelSize}});
    stream.finish();
}

uint64_t NeighborSearch::countPairs(CommandStream& stream, const SurfaceVoxels& voxels, const SurfelsByVoxel& byVoxel,
                                    const SurfelNeighbors& neighbors, const Buffer& counts) const {
    const Buffer total(stream.device(), "number of all neighbors", 2 * sizeof(uint32_t));
    stream.fill(counts, 0);
    stream.fill(total, 0);
    stream.dispatch(count_, byVoxel.sortedCount,
                    {voxels,
                     {"SortedRef", byVoxel.sorted.ref()},
                     {"surfelRanges", byVoxel.ranges},
                     {"counts", counts},
                     {"total", total},
                     {"count", byVoxel.sortedCount},
                     {"radius", neighbors.radius * voxels.grid.voxelSize}});
    const std::vector<uint32_t> sums = stream.readAs<uint32_t>(total, 2);
    return sums[0] + (uint64_t(sums[1]) << 8);
}

void NeighborSearch::update(CommandStream& stream, const SurfaceVoxels& voxels, const Surfels& surfels,
                            const SurfelsByVoxel& byVoxel, const Buffer& boxes, float reach,
                            SurfelNeighbors& neighbors) {
    // A smaller radius depends on how many pairs larger ones have
    if (neighbors.radius < 1) return run(stream, voxels, surfels, byVoxel, neighbors);
    const Buffer listed(stream.device(), "surfels near a change", surfels.count * sizeof(uint32_t));
    const uint32_t count = listChanged(stream, surfels, boxes, reach + voxels.grid.voxelSize, listed);
    const uint64_t places = neighbors.pairs.bytes() / kPairBytes;
    stream.dispatch(update_, count,
                    {voxels,
                     {"SortedRef", byVoxel.sorted.ref()},
                     {"surfelRanges", byVoxel.ranges},
                     {"listedSurfels", listed},
                     {"SortedIndicesRef", byVoxel.sortedIndices.ref()},
                     {"ranges", neighbors.ranges},
                     {"places", places_},
                     {"PairsRef", neighbors.pairs.ref()},
                     {"used", used_},
                     {"count", count},
                     {"radius", neighbors.radius * voxels.grid.voxelSize},
                     {"allPlaces", uint32_t(places)}});
    const std::vector<uint32_t> used = stream.readAs<uint32_t>(used_, 2);
    if (used[0] > pairsOnFlatSurfaces(surfels.pointCount, voxels.voxelCount) || used[1] > places)
        run(stream, voxels, surfels, byVoxel, neighbors);
}

uint32_t NeighborSearch::listChanged(CommandStream& stream, const Surfels& surfels, const Buffer& boxes, float reach,
                                     const Buffer& listed) const {
    const Buffer count(stream.device(), "number of surfels near a change", sizeof(uint32_t));
    stream.fill(count, 0);
    for (const Surfels::Chunk& chunk : surfels.chunks)
        stream.dispatch(listChanged_, chunk.count,
                        {{"boxes", boxes},
                         {"surfels", chunk.surfels},
                         {"listedSurfels", listed},
                         {"listedCount", count},
                         {"count", chunk.count},
                         {"firstIndex", chunk.firstIndex},
                         {"reach", reach}});
    return stream.readAs<uint32_t>(count, 1)[0];
}

}  // namespace voxray
