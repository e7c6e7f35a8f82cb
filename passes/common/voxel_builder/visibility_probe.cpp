#include "passes/common/voxel_builder/visibility_probe.h"

#include <algorithm>

#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchPoints = 1u << 18;
constexpr uint64_t kCounts = 9;  // Per voxel, as in count_visible_points.comp.
constexpr uint32_t kMaxPointsPerVoxel = (1u << 16) - 1;

struct ProbePoint {  // As in probe_point.glsl.
    glm::vec3 position;
    uint32_t triangle;
};

/// Number of probes on a triangle: its area in voxel faces times `pointsPerFace`, rounded up or down so that
/// the mean over triangles is right: up where the fraction plus the triangle's van der Corput number reach 1.
/// Consecutive triangles have well distributed numbers.
uint64_t pointsOn(const Geometry& g, const gpu::VoxelGrid& grid, uint32_t triangle, uint32_t pointsPerFace) {
    const double face = double(grid.voxelSize) * grid.voxelSize;
    uint32_t reversed = 0;
    for (uint32_t bit = 0; bit < 32; ++bit) reversed |= (triangle >> bit & 1u) << (31 - bit);
    const double points = triangleArea(g, triangle) / face * pointsPerFace;
    return uint64_t(points + double(reversed) / 4294967296.0);
}

}  // namespace

VisibilityProbe::VisibilityProbe(ProgramOwner& owner)
    : generateRays_(owner, "generate_visibility_rays.comp"), count_(owner, "count_visible_points.comp") {}

Buffer VisibilityProbe::run(PassContext& context, const SurfaceVoxels& voxels, const std::vector<uint32_t>& triangles,
                            uint32_t pointsPerFace) const {
    CommandStream& stream = context.stream;
    Buffer counts(context.device, "visibility counts",
                  std::max<uint64_t>(voxels.voxelCount, 1) * kCounts * sizeof(uint32_t));
    stream.fill(counts, 0);
    if (pointsPerFace == 0 || voxels.voxelCount == 0) return counts;

    // In batches: the host lists probes of all triangles; the device drops those outside `voxels`, traces two
    // rays to each remaining one, and counts those whose surfaces they reach.
    const Buffer candidates(context.device, "visibility probes", kBatchPoints * sizeof(glm::uvec2));
    const Buffer overflow(context.device, "overflow of visibility counts", sizeof(uint32_t));
    stream.fill(overflow, 0);
    const Buffer pointCount(context.device, "number of visibility probes", sizeof(uint32_t));
    const Buffer rays(context.device, "visibility rays", 2ull * kBatchPoints * sizeof(Ray));
    const Buffer hits(context.device, "visibility results", 2ull * kBatchPoints * sizeof(Hit));
    const Buffer probePoints(context.device, "visibility probes in voxels", kBatchPoints * sizeof(ProbePoint));
    std::vector<glm::uvec2> points;  // Triangle, and index of the point on it.
    const auto probe = [&] {
        if (points.empty()) return;
        stream.upload(candidates, points);
        stream.fill(pointCount, 0);
        context.dispatch(generateRays_, points.size(),
                         {context.scene,
                          voxels,
                          {"candidates", candidates},
                          {"probePoints", probePoints},
                          {"rays", rays},
                          {"pointCount", pointCount},
                          {"count", uint32_t(points.size())},
                          {"seed", randomSeed(context.frame)}});
        points.clear();
        const uint32_t count = stream.readAs<uint32_t>(pointCount, 1)[0];
        if (count == 0) return;
        context.tracer.closestHit(stream, rays, hits, 2 * count);
        context.dispatch(count_, count,
                         {context.scene,
                          voxels,
                          {"probePoints", probePoints},
                          {"rays", rays},
                          {"hits", hits},
                          {"counts", counts},
                          {"overflow", overflow},
                          {"count", count}});
    };
    for (const uint32_t triangle : triangles) {
        const uint64_t count = pointsOn(context.frame.scene->geometry, voxels.grid, triangle, pointsPerFace);
        for (uint64_t i = 0; i < count; ++i) {
            points.push_back({triangle, uint32_t(i)});
            if (points.size() == kBatchPoints) probe();
        }
    }
    probe();
    if (stream.readAs<uint32_t>(overflow, 1)[0] != 0)
        throw Error("a voxel has more than {} visibility probes: raise 'resolution', or lower 'visibility_rays'",
                    kMaxPointsPerVoxel);
    return counts;
}

}  // namespace voxray
