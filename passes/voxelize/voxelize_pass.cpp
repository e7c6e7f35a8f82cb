#include "passes/voxelize/voxelize_pass.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/dispatch.h"

namespace voxray {
namespace {

constexpr uint32_t kSumsPerVoxel = 13;  // As in voxelize.frag and resolve.comp.

struct RasterPush {
    gpu::VoxelGrid grid;
    uint32_t axis;
    uint32_t samples;
    float emissionScale;
};

struct ResolvePush {
    uint32_t voxelCount;
    float largestEmission;
};

}  // namespace

void VoxelizePass::declare(PassBuilder& builder) {
    voxels_ = builder.write<SurfaceVoxels>("voxels", "surface voxels with their materials");
}

void VoxelizePass::plan(PassPlan& plan) {
    const Geometry& geometry = plan.frame.scene->geometry;
    SurfaceVoxels& v = plan.get(voxels_);
    v.exposedOnly = params_.exposureRays > 0;
    v.grid = makeVoxelGrid(geometry.boundsMin, geometry.boundsMax, params_.resolution);
    plan.reserve("occupancy and ranks", v.words() * 2 * sizeof(uint32_t));
    v.voxelCount = uint32_t(std::min<uint64_t>(estimateSurfaceVoxels(geometry, v.grid), UINT32_MAX));
    plan.reserve("surface voxels (estimated)", v.voxelCount * sizeof(gpu::VoxelMaterial));

    for (const Material& material : plan.frame.scene->scene->materials)
        for (int c = 0; c < 3; ++c) largestEmission_ = std::max(largestEmission_, material.emission[c]);
}

void VoxelizePass::prepare(PassSetup& setup) {
    SurfaceVoxels& v = setup.get(voxels_);
    v.occupancy = Buffer(setup.device, "voxel occupancy", v.words() * sizeof(uint32_t));
    v.rank = Buffer(setup.device, "voxel ranks", v.words() * sizeof(uint32_t));

    const ShaderModule vertex = setup.compiler.compile("passes/voxelize/voxelize.vert");
    const ShaderModule mark[] = {vertex,
                                 setup.compiler.compile("passes/voxelize/voxelize.frag", {{"MARK", "1"}})};
    const ShaderModule accumulate[] = {vertex, setup.compiler.compile("passes/voxelize/voxelize.frag")};
    mark_ = makeRasterProgram(setup.device, mark, {});
    accumulate_ = makeRasterProgram(setup.device, accumulate, {});
    resolve_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/voxelize/resolve.comp"));
    prefixSum_.emplace(setup.device, setup.compiler);
    exposureProbe_ = ExposureProbe(setup.device, setup.compiler);
}

void VoxelizePass::record(PassContext& context) {
    SurfaceVoxels& v = context.get(voxels_);

    // Mark occupied voxels, then number them.
    context.stream.fill(v.occupancy, 0);
    rasterize(context, mark_, v.occupancy, 0);
    v.voxelCount = prefixSum_->run(context.stream, v.occupancy, v.rank, uint32_t(v.words()));
    if (v.voxelCount == 0)
        throw Error("voxelize: no surface meets the grid of {}x{}x{} voxels; raise 'samples' or 'resolution'",
                    v.grid.resolution.x, v.grid.resolution.y, v.grid.resolution.z);
    v.materials =
        Buffer(context.device, "voxel materials", uint64_t(v.voxelCount) * sizeof(gpu::VoxelMaterial));

    // Sum what each voxel's fragments carry, in fixed point, and turn sums into averages.
    const Buffer sums(context.device, "voxelization sums",
                      uint64_t(v.voxelCount) * kSumsPerVoxel * sizeof(uint32_t));
    context.stream.fill(sums, 0);
    rasterize(context, accumulate_, sums, largestEmission_ > 0 ? 1.0f / largestEmission_ : 0.0f);
    const Buffer probes = exposureProbe_.run(context, v, params_.exposureRays);
    context.stream.dispatch(resolve_, {{"sums", sums}, {"materials", v.materials}, {"probes", probes}},
                            ResolvePush{v.voxelCount, largestEmission_}, linearGroups(v.voxelCount));
    context.stream.finish();
}

void VoxelizePass::rasterize(PassContext& context, const Program& program, const Buffer& target,
                             float emissionScale) {
    const SurfaceVoxels& v = context.get(voxels_);
    for (uint32_t axis = 0; axis < 3; ++axis) {
        // The image plane is spanned by the two axes that follow in cyclic order.
        RasterTargets targets;
        targets.extent = {v.grid.resolution[int(axis + 1) % 3] * params_.samples,
                          v.grid.resolution[int(axis + 2) % 3] * params_.samples, 1};
        const bool marking = &program == &mark_;
        std::vector<Binding> bindings = context.scene.bindings({{marking ? "occupancy" : "sums", target}});
        if (!marking) {
            bindings.push_back({"voxelOccupancy", v.occupancy});
            bindings.push_back({"voxelRank", v.rank});
        }
        context.stream.draw(program, bindings, RasterPush{v.grid, axis, params_.samples, emissionScale},
                            targets, context.scene.triangleCount * 3);
    }
}

}  // namespace voxray
