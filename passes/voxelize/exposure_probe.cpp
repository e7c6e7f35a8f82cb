#include "passes/voxelize/exposure_probe.h"

#include <algorithm>
#include <vector>

#include "passes/common/dispatch.h"
#include "passes/common/random_seed.h"
#include "passes/common/surface_points.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchPoints =
    1u << 19;  // Two rays each: bounds the memory of rays and results to 36 MiB.

struct Push {
    gpu::VoxelGrid grid;
    uint32_t firstPoint;
    uint32_t points;
    uint32_t seed;
};

}  // namespace

ExposureProbe::ExposureProbe(Device& device, const ShaderCompiler& compiler)
    : emit_(makeComputeProgram(device, compiler.compile("passes/voxelize/probe_emit.comp"))),
      count_(makeComputeProgram(device, compiler.compile("passes/voxelize/probe_count.comp"))) {}

Buffer ExposureProbe::run(PassContext& context, const SurfaceVoxels& voxels, uint32_t pointsPerVoxel) const {
    CommandStream& stream = context.stream;
    Buffer counts(context.device, "exposure counts", uint64_t(voxels.voxelCount) * 9 * sizeof(uint32_t));
    stream.fill(counts, 0);
    if (pointsPerVoxel == 0) return counts;

    // Evenly spread points, batch by batch: two rays each, as long as a voxel.
    const uint64_t count = std::min<uint64_t>(uint64_t(voxels.voxelCount) * pointsPerVoxel, 1u << 28);
    const std::vector<uint32_t> triangles = spreadPoints(context.frame.scene->geometry, count);
    const uint32_t batch = uint32_t(std::min<uint64_t>(count, kBatchPoints));
    const Buffer batchTriangles(context.device, "exposure points", batch * sizeof(uint32_t));
    const Buffer rays(context.device, "exposure rays", 2ull * batch * sizeof(Ray));
    const Buffer occluded(context.device, "exposure results", 2ull * batch * sizeof(uint32_t));
    for (uint64_t first = 0; first < count; first += batch) {
        const uint32_t points = uint32_t(std::min<uint64_t>(batch, count - first));
        stream.upload(batchTriangles, std::as_bytes(std::span(triangles).subspan(first, points)));
        const Push push{voxels.grid, uint32_t(first), points, randomSeed(context.frame)};
        stream.dispatch(emit_, context.scene.bindings({{"pointTriangles", batchTriangles}, {"rays", rays}}),
                        push, linearGroups(points));
        context.tracer.occluded(stream, rays, occluded, 2 * points);
        stream.dispatch(count_,
                        {{"voxelOccupancy", voxels.occupancy},
                         {"voxelRank", voxels.rank},
                         {"rays", rays},
                         {"occluded", occluded},
                         {"counts", counts}},
                        push, linearGroups(points));
    }
    stream.finish();
    return counts;
}

}  // namespace voxray
