#include "passes/common/voxel_builder/visibility_probe.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchPoints = 1u << 18;
constexpr uint64_t kCounts = 9;  // Of a voxel, as in visibility_count.comp.

struct ProbePoint {  // As in visibility_point.glsl.
    glm::vec3 position;
    uint32_t triangle;
};

/// Number of probes on a triangle: its area in voxel faces times `pointsPerFace`, rounded so that the mean
/// over triangles is right: up where the fraction and the triangle's number in the van der Corput sequence
/// add up to
/// 1. The sequence is spread evenly over triangles that are neighbours in the list.
uint64_t pointsOn(const Geometry& g, const gpu::VoxelGrid& grid, uint32_t triangle, uint32_t pointsPerFace) {
    const glm::uvec3 v = g.triangles[triangle];
    const glm::dvec3 p0 = g.positions[v.x], p1 = g.positions[v.y], p2 = g.positions[v.z];
    const double face = double(grid.voxelSize) * grid.voxelSize;
    uint32_t reversed = 0;
    for (uint32_t bit = 0; bit < 32; ++bit) reversed |= (triangle >> bit & 1u) << (31 - bit);
    const double points = 0.5 * glm::length(glm::cross(p1 - p0, p2 - p0)) / face * pointsPerFace;
    return uint64_t(points + double(reversed) / 4294967296.0);
}

}  // namespace

VisibilityProbe::VisibilityProbe(ProgramOwner& owner)
    : emit_(owner, "visibility_emit.comp"), count_(owner, "visibility_count.comp") {}

Buffer VisibilityProbe::run(PassContext& context, const SurfaceVoxels& voxels,
                            const std::vector<uint32_t>& triangles, uint32_t pointsPerFace) const {
    CommandStream& stream = context.stream;
    Buffer counts(context.device, "visibility counts",
                  std::max<uint64_t>(voxels.voxelCount, 1) * kCounts * sizeof(uint32_t));
    stream.fill(counts, 0);
    if (pointsPerFace == 0 || voxels.voxelCount == 0) return counts;

    // In batches: two rays to each point that lies in one of the voxels; whether they meet its surface, into
    // the counts of the point's voxel. The host makes points of all triangles, the device drops those
    // elsewhere.
    const Buffer batch(context.device, "visibility probes", kBatchPoints * sizeof(glm::uvec2));
    const Buffer kept(context.device, "number of visibility probes", sizeof(uint32_t));
    const Buffer rays(context.device, "visibility rays", 2ull * kBatchPoints * sizeof(Ray));
    const Buffer hits(context.device, "visibility results", 2ull * kBatchPoints * sizeof(Hit));
    const Buffer keptPoints(context.device, "visibility probes in voxels", kBatchPoints * sizeof(ProbePoint));
    std::vector<glm::uvec2> points;  // Triangle, and number of the point on it.
    const auto probe = [&] {
        if (points.empty()) return;
        stream.upload(batch, points);
        stream.fill(kept, 0);
        context.dispatch(emit_, points.size(),
                         {context.scene,
                          voxels,
                          {"points", batch},
                          {"keptPoints", keptPoints},
                          {"rays", rays},
                          {"kept", kept},
                          {"count", uint32_t(points.size())},
                          {"seed", randomSeed(context.frame)}});
        points.clear();
        const uint32_t count = stream.readAs<uint32_t>(kept, 1)[0];
        if (count == 0) return;
        context.tracer.closestHit(stream, rays, hits, 2 * count);
        context.dispatch(count_, count,
                         {context.scene,
                          voxels,
                          {"keptPoints", keptPoints},
                          {"rays", rays},
                          {"hits", hits},
                          {"counts", counts},
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
    stream.finish();
    return counts;
}

}  // namespace voxray
