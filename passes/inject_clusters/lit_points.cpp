#include "passes/inject_clusters/lit_points.h"

#include <algorithm>

#include "passes/common/compute/dispatch.h"
#include "trace/ray.h"

namespace voxray {
namespace {

constexpr uint32_t kPoints = 18;  // As in lit_points.glsl.
constexpr uint32_t kBatchVoxels = (1u << 20) / kPoints;

struct Push {
    gpu::VoxelGrid grid;
    uint32_t firstVoxel;
    uint32_t voxels;
    uint32_t light;
};

}  // namespace

void LitPoints::plan(PassPlan& plan) {
    plan.scratchBuffer(rays_, "rays from points round voxels", kBatchVoxels * kPoints * sizeof(Ray));
    plan.scratchBuffer(occluded_, "visibility of points", kBatchVoxels * kPoints * sizeof(uint32_t));
}

void LitPoints::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    aim_ = program("passes/inject_clusters/aim_points.comp");
    add_ = program("passes/inject_clusters/add_lit.comp");
}

void LitPoints::measure(PassContext& context, const std::vector<LightSource>& sources,
                        const SurfaceVoxels& voxels, const VoxelClusters& clusters,
                        const VoxelPatches& patches, const LargeBuffer& surfels) const {
    CommandStream& stream = context.stream;
    for (const LightSource& source : sources)
        for (uint32_t first = 0; first < voxels.voxelCount; first += kBatchVoxels) {
            const uint32_t count = std::min(kBatchVoxels, voxels.voxelCount - first);
            const Push push{voxels.grid, first, count, source.light};
            stream.dispatch(aim_,
                            context.scene.bindings({{"coordinates", clusters.coordinates}, {"rays", rays_}}),
                            push, linearGroups(count * kPoints));
            context.tracer.occluded(stream, rays_, occluded_, count * kPoints);
            stream.dispatch(add_,
                            context.scene.bindings({{"coordinates", clusters.coordinates},
                                                    {"voxelOccupancy", voxels.occupancy},
                                                    {"voxelRank", voxels.rank},
                                                    {"VoxelMaterialsAt", patches.materials.at()},
                                                    {"rays", rays_},
                                                    {"occluded", occluded_},
                                                    {"firstSide", patches.firstSide},
                                                    {"sides", patches.sides},
                                                    {"PatchSurfelsAt", patches.surfels.at()},
                                                    {"PlacedAt", surfels.at()}}),
                            push, linearGroups(count));
        }
}

}  // namespace voxray
