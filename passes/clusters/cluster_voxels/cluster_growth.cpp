#include "passes/clusters/cluster_voxels/cluster_growth.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "base/error.h"

namespace voxray {
namespace {

constexpr uint64_t kSumBytes = 7 * sizeof(uint64_t);  // Of a seed, as in sums.glsl.
constexpr uint32_t kMaxRounds = 256;                  // Some ten are needed: the order is random.

Defines waysOf(const ClusterParams& params) {
    Defines ways;
    if (params.normals == ClusterNormals::OpenSpace) ways.emplace("OPEN_SPACE", "1");
    if (params.asksFragments()) ways.emplace("FRAGMENTS", "1");
    return ways;
}

uint64_t product(glm::uvec3 v) {
    return uint64_t(v.x) * v.y * v.z;
}

}  // namespace

ClusterGrowth::ClusterGrowth(ProgramOwner& owner, const ClusterParams& params)
    : params_(params),
      normals_(owner, "normals.comp", waysOf(params)),
      seed_(owner, "seed.comp"),
      assign_(owner, "assign.comp"),
      add_(owner, "add.comp"),
      update_(owner, "update.comp"),
      own_(owner, "own.comp"),
      lead_(owner, "lead.comp"),
      join_(owner, "join.comp"),
      nearest_(owner, "nearest.comp") {}

glm::uvec3 ClusterGrowth::cells(const gpu::VoxelGrid& grid, uint32_t voxelCount) const {
    // Cells of w³ voxels, of which the paper's `initial` fill a cube. A flat surface leaves w² voxels in
    // each, and `first`, whose clusters take all in their reach, gives (2w)² to a cluster.
    const double longest = std::max({grid.resolution.x, grid.resolution.y, grid.resolution.z});
    double width = longest / std::cbrt(double(std::max(params_.initial, 1u)));
    if (params_.initial == 0) {
        width = std::sqrt(double(voxelCount) / params_.target);
        if (params_.assign == ClusterAssignment::First) width /= 2;
    }
    return glm::max(glm::uvec3(glm::round(glm::dvec3(grid.resolution) / std::max(width, 1.0))),
                    glm::uvec3(1));
}

void ClusterGrowth::findNormals(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& coordinates,
                                const FragmentAngles::Sums& fragments, Result& result) const {
    const uint32_t count = voxels.voxelCount;
    result.normals = Buffer(stream.device(), "voxel normals", count * sizeof(glm::vec3));
    Buffer counts;
    if (params_.normals == ClusterNormals::OpenSpace) {
        counts = Buffer(stream.device(), "ways of voxels", sizeof(OpenSpaceCounts));
        stream.fill(counts, 0);
    }
    stream.dispatch(normals_, count,
                    {voxels,
                     ifUsed({"coordinates", coordinates}),
                     ifUsed({"counts", counts}),
                     ifUsed({"fragmentAngles", fragments.angles}),
                     {"normals", result.normals},
                     {"count", count},
                     {"unitsPerRadian", fragments.unitsPerRadian}});
    if (counts) result.openSpace = stream.readAs<OpenSpaceCounts>(counts, 1)[0];
}

ClusterGrowth::Result ClusterGrowth::grow(CommandStream& stream, const SurfaceVoxels& voxels,
                                          const Buffer& coordinates,
                                          const FragmentAngles::Sums& fragments) const {
    Device& device = stream.device();
    const uint32_t count = voxels.voxelCount;
    const glm::uvec3 along = cells(voxels.grid, count);
    if (product(along) > 1u << 26)
        throw Error("cluster_voxels: {} seeds are too many; lower 'initial' or 'target'", product(along));
    Result result;
    result.seeds = uint32_t(product(along));
    findNormals(stream, voxels, coordinates, fragments, result);

    // Seeds
    const glm::vec3 widths = glm::vec3(voxels.grid.resolution) / glm::vec3(along);
    const float reach = params_.reach * std::max({widths.x, widths.y, widths.z});
    // Of neighbourhood.glsl
    const auto neighbourhood = [&](uint32_t threads) {
        return Bindings{voxels,
                        ifUsed({"normals", result.normals}),
                        {"count", threads},
                        {"reach", reach},
                        {"minCosine", std::cos(glm::radians(params_.maxAngle))},
                        {"first", params_.assign == ClusterAssignment::First},
                        {"firstOwn", result.seeds}}
            .all();
    };
    const Buffer cellsAlong(device, "cells along each axis", sizeof(glm::uvec3));
    stream.upload(cellsAlong, std::as_bytes(std::span(&along, 1)));
    result.seedList = Buffer(device, "cluster seeds", result.seeds * sizeof(gpu::ClusterSeed));
    stream.dispatch(seed_, result.seeds,
                    {neighbourhood(result.seeds), {"seeds", result.seedList}, {"cells", cellsAlong}});

    // Voxels choose, clusters move
    const Buffer nearest(device, "nearest clusters", count * sizeof(uint64_t));
    const Buffer sums(device, "sums of clusters", result.seeds * kSumBytes);
    for (uint32_t i = 0; i < params_.iterations; ++i) {
        stream.fill(nearest, ~0u);
        stream.dispatch(assign_, result.seeds,
                        {neighbourhood(result.seeds), {"seeds", result.seedList}, {"nearest", nearest}});
        if (i + 1 == params_.iterations) break;
        stream.fill(sums, 0);
        stream.dispatch(add_, count,
                        {{"nearest", nearest},
                         {"coordinates", coordinates},
                         {"normals", result.normals},
                         {"sums", sums},
                         {"count", count}});
        stream.dispatch(update_, result.seeds,
                        {{"sums", sums}, {"seeds", result.seedList}, {"count", result.seeds}});
        stream.finish();
    }

    const Buffer unassigned(device, "voxels without a cluster", sizeof(uint32_t));
    result.owners = Buffer(device, "clusters of voxels", count * sizeof(uint32_t));
    stream.fill(unassigned, 0);
    stream.dispatch(
        own_, count,
        {{"nearest", nearest}, {"owners", result.owners}, {"unassigned", unassigned}, {"count", count}});
    result.unassigned = stream.readAs<uint32_t>(unassigned, 1)[0];

    // The extra pass
    const Buffer other(device, "voxels that lead or join", count * sizeof(uint32_t));
    const Bindings owners{neighbourhood(count), {"coordinates", coordinates}, {"owners", result.owners}};
    uint32_t left = result.unassigned;
    if (params_.unassigned == UnassignedVoxels::Nearest && left > 0 && left < count) {
        stream.dispatch(nearest_, count, {owners.all(), {"joined", other}});
        stream.copy(other, result.owners, count * sizeof(uint32_t));
    }
    if (params_.unassigned == UnassignedVoxels::Own) {
        for (uint32_t round = 0; left > 0; ++round) {
            if (round == kMaxRounds)
                throw Error("cluster_voxels: {} voxels found no cluster in {} rounds", left, round);
            stream.dispatch(lead_, count, {owners.all(), {"leads", other}});
            stream.fill(unassigned, 0);
            stream.dispatch(join_, count, {owners.all(), {"leads", other}, {"unassigned", unassigned}});
            left = stream.readAs<uint32_t>(unassigned, 1)[0];
        }
    }
    stream.finish();
    return result;
}

}  // namespace voxray
