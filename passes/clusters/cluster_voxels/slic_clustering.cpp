#include "passes/clusters/cluster_voxels/slic_clustering.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "base/error.h"

namespace voxray {
namespace {

constexpr uint64_t kSumBytes = 7 * sizeof(uint64_t);  // For each seed (cluster_sums.glsl).
/// Rounds in which new seeds are selected; O(log n) are expected, about ten (Luby 1986).
constexpr uint32_t kMaxNewSeedRounds = 256;

/// The least occupied direction is the one of the six axis directions with the fewest occupied voxels in front.
Defines normalDefines(const ClusterParams& params) {
    Defines defines;
    if (params.normals == ClusterNormals::LeastOccupiedDirection) defines.emplace("LEAST_OCCUPIED_DIRECTION", "1");
    if (params.usesFragments()) defines.emplace("FRAGMENTS", "1");
    return defines;
}

uint64_t product(glm::uvec3 v) {
    return uint64_t(v.x) * v.y * v.z;
}

}  // namespace

SlicClustering::SlicClustering(ProgramOwner& owner, const ClusterParams& params)
    : params_(params),
      findNormals_(owner, "voxel_normals.comp", normalDefines(params)),
      initSeeds_(owner, "init_seeds.comp"),
      assignVoxels_(owner, "assign_voxels.comp"),
      accumulateSums_(owner, "accumulate_sums.comp"),
      updateSeeds_(owner, "update_seeds.comp"),
      extractAssignment_(owner, "extract_assignment.comp"),
      selectNewSeeds_(owner, "select_new_seeds.comp"),
      joinNewSeeds_(owner, "join_new_seeds.comp"),
      joinNearestCluster_(owner, "join_nearest_cluster.comp") {}

glm::uvec3 SlicClustering::seedGridResolution(const gpu::VoxelGrid& grid, uint32_t voxelCount) const {
    // Seeds lie on a grid of cells w voxels wide. `initial` is the number of seeds in a cube as wide as the voxel
    // grid's longest axis. On a flat surface a cell holds w² voxels, hence w = sqrt(voxels / target). With 'assign:
    // nearest' neighbors divide the space between them, and clusters are about a cell wide. With 'first' a cluster may
    // fill its search box, 2w wide at 'reach: 1'; so w is halved
    const uint32_t seedsPerCube = params_.initial, targetClusters = params_.target;
    const double longest = std::max({grid.resolution.x, grid.resolution.y, grid.resolution.z});
    double width = longest / std::cbrt(double(std::max(seedsPerCube, 1u)));
    if (seedsPerCube == 0) {
        width = std::sqrt(double(voxelCount) / targetClusters);
        if (params_.assign == ClusterAssignment::FirstInRandomOrder) width /= 2;
    }
    return glm::max(glm::uvec3(glm::round(glm::dvec3(grid.resolution) / std::max(width, 1.0))), glm::uvec3(1));
}

void SlicClustering::findNormals(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& coordinates,
                                 const FragmentAngleSums::Sums& angleSums, Result& result) const {
    const uint32_t count = voxels.voxelCount;
    result.normals = Buffer(stream.device(), "voxel normals", count * sizeof(glm::vec3));
    Buffer counts;
    if (params_.normals == ClusterNormals::LeastOccupiedDirection) {
        counts = Buffer(stream.device(), "voxels by choice of normal", sizeof(NormalCounts));
        stream.fill(counts, 0);
    }
    stream.dispatch(findNormals_, count,
                    {voxels,
                     ifUsed({"coordinates", coordinates}),
                     ifUsed({"counts", counts}),
                     ifUsed({"fragmentAngleSums", angleSums.angles}),
                     {"normals", result.normals},
                     {"count", count},
                     {"fixedPointScale", angleSums.fixedPointScale}});
    if (counts) result.normalCounts = stream.readAs<NormalCounts>(counts, 1)[0];
}

SlicClustering::Result SlicClustering::run(CommandStream& stream, const SurfaceVoxels& voxels,
                                           const Buffer& coordinates, const FragmentAngleSums::Sums& angleSums) const {
    Device& device = stream.device();
    const uint32_t count = voxels.voxelCount;
    const glm::uvec3 seedGrid = seedGridResolution(voxels.grid, count);
    if (product(seedGrid) > 1u << 26)
        throw Error("cluster_voxels: {} seeds are too many; lower 'initial' (seeds in a cube) or 'target' (clusters)",
                    product(seedGrid));
    Result result;
    result.seedCount = uint32_t(product(seedGrid));
    findNormals(stream, voxels, coordinates, angleSums, result);

    const glm::vec3 widths = glm::vec3(voxels.grid.resolution) / glm::vec3(seedGrid);
    const float searchRadius = params_.reach * std::max({widths.x, widths.y, widths.z});
    // The bindings of neighborhood.glsl
    const auto neighborhood = [&](uint32_t threads) {
        return Bindings{voxels,
                        ifUsed({"normals", result.normals}),
                        {"count", threads},
                        {"searchRadius", searchRadius},
                        {"minCosine", std::cos(glm::radians(params_.maxAngle))},
                        {"firstInRandomOrder", params_.assign == ClusterAssignment::FirstInRandomOrder},
                        {"seedCount", result.seedCount}}
            .all();
    };
    const Buffer seedGridBuffer(device, "resolution of the seeds' grid", sizeof(glm::uvec3));
    stream.upload(seedGridBuffer, std::as_bytes(std::span(&seedGrid, 1)));
    result.seeds = Buffer(device, "cluster seeds", result.seedCount * sizeof(gpu::ClusterSeed));
    stream.dispatch(initSeeds_, result.seedCount,
                    {neighborhood(result.seedCount), {"seeds", result.seeds}, {"seedGrid", seedGridBuffer}});

    // Cosin and Patow 2022, algorithm 1
    const Buffer bestSeed(device, "best seeds of voxels", count * sizeof(uint64_t));
    const Buffer sums(device, "sums of clusters", result.seedCount * kSumBytes);
    for (uint32_t i = 0; i < params_.iterations; ++i) {
        stream.fill(bestSeed, ~0u);
        stream.dispatch(assignVoxels_, result.seedCount,
                        {neighborhood(result.seedCount), {"seeds", result.seeds}, {"bestSeed", bestSeed}});
        if (i + 1 == params_.iterations) break;
        stream.fill(sums, 0);
        stream.dispatch(accumulateSums_, count,
                        {{"bestSeed", bestSeed},
                         {"coordinates", coordinates},
                         {"normals", result.normals},
                         {"sums", sums},
                         {"count", count}});
        stream.dispatch(updateSeeds_, result.seedCount,
                        {{"sums", sums}, {"seeds", result.seeds}, {"count", result.seedCount}});
        stream.finish();
    }

    // Store the assignment, and count voxels without a cluster
    const Buffer unassignedCount(device, "voxels without a cluster", sizeof(uint32_t));
    result.assignment = Buffer(device, "clusters of voxels", count * sizeof(uint32_t));
    stream.fill(unassignedCount, 0);
    stream.dispatch(
        extractAssignment_, count,
        {{"bestSeed", bestSeed}, {"assignment", result.assignment}, {"unassigned", unassignedCount}, {"count", count}});
    result.unassignedCount = stream.readAs<uint32_t>(unassignedCount, 1)[0];

    // These voxels join the nearest cluster or form new ones
    const Buffer newAssignmentOrSeeds(device, "new clusters of voxels", count * sizeof(uint32_t));
    const Bindings assignment{neighborhood(count), {"coordinates", coordinates}, {"assignment", result.assignment}};
    uint32_t remaining = result.unassignedCount;
    if (params_.unassignedPolicy == UnassignedVoxels::Nearest && remaining > 0 && remaining < count) {
        stream.dispatch(joinNearestCluster_, count, {assignment.all(), {"newAssignment", newAssignmentOrSeeds}});
        stream.copy(newAssignmentOrSeeds, result.assignment, count * sizeof(uint32_t));
    }
    if (params_.unassignedPolicy == UnassignedVoxels::NewClusters) {
        for (uint32_t round = 0; remaining > 0; ++round) {
            if (round == kMaxNewSeedRounds)
                throw Error("cluster_voxels: {} voxels found no cluster in {} rounds", remaining, round);
            stream.dispatch(selectNewSeeds_, count, {assignment.all(), {"isNewSeed", newAssignmentOrSeeds}});
            stream.fill(unassignedCount, 0);
            stream.dispatch(joinNewSeeds_, count,
                            {assignment.all(), {"isNewSeed", newAssignmentOrSeeds}, {"unassigned", unassignedCount}});
            remaining = stream.readAs<uint32_t>(unassignedCount, 1)[0];
        }
    }
    stream.finish();
    return result;
}

}  // namespace voxray
