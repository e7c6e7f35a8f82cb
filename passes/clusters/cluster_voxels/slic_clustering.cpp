#include "passes/clusters/cluster_voxels/slic_clustering.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "base/error.h"

namespace voxray {
namespace {

constexpr uint64_t kSumBytes = 7 * sizeof(uint64_t);  // For each seed (cluster_sums.glsl).
constexpr uint32_t kMaxRounds = 256;                  // About ten are expected (Luby 1986).

Defines normalDefines(const ClusterParams& params) {
    Defines defines;
    if (params.normals == ClusterNormals::OpenSpace) defines.emplace("OPEN_SPACE", "1");
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
      selectIndependentSet_(owner, "select_independent_set.comp"),
      joinNewSeeds_(owner, "join_new_seeds.comp"),
      joinNearestCluster_(owner, "join_nearest_cluster.comp") {}

glm::uvec3 SlicClustering::seedCells(const gpu::VoxelGrid& grid, uint32_t voxelCount) const {
    // Each seed has a cell of w³ voxels; a cube has `initial` cells. A flat surface has w² voxels in a cell;
    // with `first` a cluster gets all voxels within reach, (2w)²
    const double longest = std::max({grid.resolution.x, grid.resolution.y, grid.resolution.z});
    double width = longest / std::cbrt(double(std::max(params_.initial, 1u)));
    if (params_.initial == 0) {
        width = std::sqrt(double(voxelCount) / params_.target);
        if (params_.assign == ClusterAssignment::First) width /= 2;
    }
    return glm::max(glm::uvec3(glm::round(glm::dvec3(grid.resolution) / std::max(width, 1.0))), glm::uvec3(1));
}

void SlicClustering::findNormals(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& coordinates,
                                 const FragmentAngles::Sums& fragments, Result& result) const {
    const uint32_t count = voxels.voxelCount;
    result.normals = Buffer(stream.device(), "voxel normals", count * sizeof(glm::vec3));
    Buffer counts;
    if (params_.normals == ClusterNormals::OpenSpace) {
        counts = Buffer(stream.device(), "voxels by choice of normal", sizeof(NormalCounts));
        stream.fill(counts, 0);
    }
    stream.dispatch(findNormals_, count,
                    {voxels,
                     ifUsed({"coordinates", coordinates}),
                     ifUsed({"counts", counts}),
                     ifUsed({"fragmentAngles", fragments.angles}),
                     {"normals", result.normals},
                     {"count", count},
                     {"fixedPointScale", fragments.fixedPointScale}});
    if (counts) result.normalCounts = stream.readAs<NormalCounts>(counts, 1)[0];
}

SlicClustering::Result SlicClustering::run(CommandStream& stream, const SurfaceVoxels& voxels,
                                           const Buffer& coordinates, const FragmentAngles::Sums& fragments) const {
    Device& device = stream.device();
    const uint32_t count = voxels.voxelCount;
    const glm::uvec3 cells = seedCells(voxels.grid, count);
    if (product(cells) > 1u << 26)
        throw Error("cluster_voxels: {} seeds are too many; lower 'initial' or 'target'", product(cells));
    Result result;
    result.seedCount = uint32_t(product(cells));
    findNormals(stream, voxels, coordinates, fragments, result);

    const glm::vec3 widths = glm::vec3(voxels.grid.resolution) / glm::vec3(cells);
    const float reach = params_.reach * std::max({widths.x, widths.y, widths.z});
    // The bindings of neighbourhood.glsl
    const auto neighbourhood = [&](uint32_t threads) {
        return Bindings{voxels,
                        ifUsed({"normals", result.normals}),
                        {"count", threads},
                        {"reach", reach},
                        {"minCosine", std::cos(glm::radians(params_.maxAngle))},
                        {"takesFirst", params_.assign == ClusterAssignment::First},
                        {"seedCount", result.seedCount}}
            .all();
    };
    const Buffer cellResolution(device, "resolution of the seeds' grid", sizeof(glm::uvec3));
    stream.upload(cellResolution, std::as_bytes(std::span(&cells, 1)));
    result.seeds = Buffer(device, "cluster seeds", result.seedCount * sizeof(gpu::ClusterSeed));
    stream.dispatch(initSeeds_, result.seedCount,
                    {neighbourhood(result.seedCount), {"seeds", result.seeds}, {"cells", cellResolution}});

    // Cosin and Patow 2022, algorithm 1
    const Buffer bestSeed(device, "best seeds of voxels", count * sizeof(uint64_t));
    const Buffer sums(device, "sums of clusters", result.seedCount * kSumBytes);
    for (uint32_t i = 0; i < params_.iterations; ++i) {
        stream.fill(bestSeed, ~0u);
        stream.dispatch(assignVoxels_, result.seedCount,
                        {neighbourhood(result.seedCount), {"seeds", result.seeds}, {"bestSeed", bestSeed}});
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
    const Buffer unassigned(device, "voxels without a cluster", sizeof(uint32_t));
    result.assignment = Buffer(device, "clusters of voxels", count * sizeof(uint32_t));
    stream.fill(unassigned, 0);
    stream.dispatch(
        extractAssignment_, count,
        {{"bestSeed", bestSeed}, {"assignment", result.assignment}, {"unassigned", unassigned}, {"count", count}});
    result.unassigned = stream.readAs<uint32_t>(unassigned, 1)[0];

    // These voxels join the nearest cluster or form new ones
    const Buffer scratch(device, "new clusters of voxels", count * sizeof(uint32_t));
    const Bindings assignment{neighbourhood(count), {"coordinates", coordinates}, {"assignment", result.assignment}};
    uint32_t remaining = result.unassigned;
    if (params_.unassigned == UnassignedVoxels::Nearest && remaining > 0 && remaining < count) {
        stream.dispatch(joinNearestCluster_, count, {assignment.all(), {"newAssignment", scratch}});
        stream.copy(scratch, result.assignment, count * sizeof(uint32_t));
    }
    if (params_.unassigned == UnassignedVoxels::NewClusters) {
        for (uint32_t round = 0; remaining > 0; ++round) {
            if (round == kMaxRounds)
                throw Error("cluster_voxels: {} voxels found no cluster in {} rounds", remaining, round);
            stream.dispatch(selectIndependentSet_, count, {assignment.all(), {"isNewSeed", scratch}});
            stream.fill(unassigned, 0);
            stream.dispatch(joinNewSeeds_, count,
                            {assignment.all(), {"isNewSeed", scratch}, {"unassigned", unassigned}});
            remaining = stream.readAs<uint32_t>(unassigned, 1)[0];
        }
    }
    stream.finish();
    return result;
}

}  // namespace voxray
