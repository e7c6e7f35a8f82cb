#include "passes/cluster_voxels/cluster_growth.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

constexpr uint64_t kSumBytes = 7 * sizeof(uint64_t);  // Of a seed, as in sums.glsl.
constexpr uint32_t kMaxRounds = 256;                  // Some ten are needed: the order is random.

struct NormalsPush {
    gpu::VoxelGrid grid;
    uint32_t count;
    float unitsPerRadian;
};

/// As in neighbourhood.glsl.
struct GrowthPush {
    gpu::VoxelGrid grid;
    uint32_t count;
    float reach;
    float minCosine;
    uint32_t first;
    uint32_t firstOwn;
};

uint64_t product(glm::uvec3 v) {
    return uint64_t(v.x) * v.y * v.z;
}

}  // namespace

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

uint64_t ClusterGrowth::seeds(const SurfaceVoxels& voxels) const {
    return product(cells(voxels.grid, voxels.voxelCount));
}

uint64_t ClusterGrowth::scratchBytes(const SurfaceVoxels& voxels) const {
    const uint64_t count = voxels.voxelCount;
    const uint64_t perVoxel = sizeof(glm::vec3) + sizeof(uint64_t) + 3 * sizeof(uint32_t);
    return count * perVoxel + seeds(voxels) * (sizeof(gpu::ClusterSeed) + kSumBytes) + 64;
}

void ClusterGrowth::prepare(Device& device, const ShaderCompiler& compiler) {
    const auto program = [&](const char* name, const Defines& defines = {}) {
        const std::string file = std::string("passes/cluster_voxels/") + name + ".comp";
        return makeComputeProgram(device, compiler.compile(file, defines));
    };
    Defines ways;
    if (params_.normals == ClusterNormals::OpenSpace) ways.emplace("OPEN_SPACE", "1");
    if (params_.asksFragments()) ways.emplace("FRAGMENTS", "1");
    normals_ = program("normals", ways);
    seed_ = program("seed");
    assign_ = program("assign");
    add_ = program("add");
    update_ = program("update");
    own_ = program("own");
    lead_ = program("lead");
    join_ = program("join");
    nearest_ = program("nearest");
}

void ClusterGrowth::findNormals(CommandStream& stream, const SurfaceVoxels& voxels, const Buffer& coordinates,
                                const FragmentAngles::Sums& fragments, Result& result) const {
    const uint32_t count = voxels.voxelCount;
    result.normals = Buffer(stream.device(), "voxel normals", count * sizeof(glm::vec3));
    std::vector<Binding> bindings = {ifUsed({"coordinates", coordinates}), {"normals", result.normals}};
    Buffer counts;
    if (params_.normals == ClusterNormals::OpenSpace) {
        counts = Buffer(stream.device(), "ways of voxels", sizeof(OpenSpaceCounts));
        stream.fill(counts, 0);
        bindings.emplace_back("counts", counts);
    }
    if (params_.asksFragments()) bindings.emplace_back("fragmentAngles", fragments.angles);
    stream.dispatch(normals_, voxels.bindings(bindings),
                    NormalsPush{voxels.grid, count, fragments.unitsPerRadian}, linearGroups(count));
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
    const auto push = [&](uint32_t threads) {
        return GrowthPush{voxels.grid,
                          threads,
                          reach,
                          std::cos(glm::radians(params_.maxAngle)),
                          params_.assign == ClusterAssignment::First ? 1u : 0u,
                          result.seeds};
    };
    const Buffer cellsAlong(device, "cells along each axis", sizeof(glm::uvec3));
    stream.upload(cellsAlong, std::as_bytes(std::span(&along, 1)));
    result.seedList = Buffer(device, "cluster seeds", result.seeds * sizeof(gpu::ClusterSeed));
    stream.dispatch(
        seed_,
        voxels.bindings({{"normals", result.normals}, {"seeds", result.seedList}, {"cells", cellsAlong}}),
        push(result.seeds), linearGroups(result.seeds));

    // Voxels choose, clusters move
    const Buffer nearest(device, "nearest clusters", count * sizeof(uint64_t));
    const Buffer sums(device, "sums of clusters", result.seeds * kSumBytes);
    for (uint32_t i = 0; i < params_.iterations; ++i) {
        stream.fill(nearest, ~0u);
        stream.dispatch(
            assign_,
            voxels.bindings({{"normals", result.normals}, {"seeds", result.seedList}, {"nearest", nearest}}),
            push(result.seeds), linearGroups(result.seeds));
        if (i + 1 == params_.iterations) break;
        stream.fill(sums, 0);
        stream.dispatch(
            add_,
            {{"nearest", nearest}, {"coordinates", coordinates}, {"normals", result.normals}, {"sums", sums}},
            count, linearGroups(count));
        stream.dispatch(update_, {{"sums", sums}, {"seeds", result.seedList}}, result.seeds,
                        linearGroups(result.seeds));
        stream.finish();
    }

    const Buffer unassigned(device, "voxels without a cluster", sizeof(uint32_t));
    result.owners = Buffer(device, "clusters of voxels", count * sizeof(uint32_t));
    stream.fill(unassigned, 0);
    stream.dispatch(own_, {{"nearest", nearest}, {"owners", result.owners}, {"unassigned", unassigned}},
                    count, linearGroups(count));
    result.unassigned = stream.readAs<uint32_t>(unassigned, 1)[0];

    // The extra pass
    const Buffer other(device, "voxels that lead or join", count * sizeof(uint32_t));
    uint32_t left = result.unassigned;
    if (params_.unassigned == UnassignedVoxels::Nearest && left > 0 && left < count) {
        stream.dispatch(nearest_,
                        voxels.bindings({ifUsed({"normals", result.normals}),
                                         {"coordinates", coordinates},
                                         {"owners", result.owners},
                                         {"joined", other}}),
                        push(count), linearGroups(count));
        stream.copy(other, result.owners, count * sizeof(uint32_t));
    }
    if (params_.unassigned == UnassignedVoxels::Own) {
        for (uint32_t round = 0; left > 0; ++round) {
            if (round == kMaxRounds)
                throw Error("cluster_voxels: {} voxels found no cluster in {} rounds", left, round);
            stream.dispatch(lead_,
                            voxels.bindings({{"normals", result.normals},
                                             {"coordinates", coordinates},
                                             {"owners", result.owners},
                                             {"leads", other}}),
                            push(count), linearGroups(count));
            stream.fill(unassigned, 0);
            stream.dispatch(join_,
                            voxels.bindings({{"normals", result.normals},
                                             {"coordinates", coordinates},
                                             {"owners", result.owners},
                                             {"leads", other},
                                             {"unassigned", unassigned}}),
                            push(count), linearGroups(count));
            left = stream.readAs<uint32_t>(unassigned, 1)[0];
        }
    }
    stream.finish();
    return result;
}

}  // namespace voxray
