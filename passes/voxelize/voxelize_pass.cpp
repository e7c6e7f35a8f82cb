#include "passes/voxelize/voxelize_pass.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/dispatch.h"
#include "passes/common/voxel_count.h"
#include "passes/voxelize/sums_layout.h"

namespace voxray {
namespace {

struct ResolvePush {
    uint32_t voxelCount;
    float largestEmission;
};

std::unique_ptr<VoxelizeMethod> makeMethod(const VoxelizePass::Params& params) {
    switch (params.method) {
        case VoxelizeMethodName::ThreeAxis:
            return makeThreeAxis(params.samples);
        case VoxelizeMethodName::DominantAxis:
            return makeDominantAxis();
        default:
            return makeExact();
    }
}

}  // namespace

VoxelizePass::VoxelizePass(const Params& params) : params_(params), method_(makeMethod(params)) {}

void VoxelizePass::declare(PassBuilder& builder) {
    voxels_ = builder.write<SurfaceVoxels>("voxels", "surface voxels with their materials");
}

void VoxelizePass::plan(PassPlan& plan) {
    if (params_.directions != 1 && params_.directions != 6)
        throw Error("voxelize: directions is {}; it can be 1 or 6", params_.directions);
    const Geometry& geometry = plan.frame.scene->geometry;
    SurfaceVoxels& v = plan.get(voxels_);
    v.exposedOnly = params_.exposureRays > 0;
    v.grid = makeVoxelGrid(geometry.boundsMin, geometry.boundsMax, params_.resolution);
    v.grid.directions = params_.directions;
    plan.reserve("occupancy and ranks", v.words() * 2 * sizeof(uint32_t));
    v.voxelCount = countSurfaceVoxels(geometry, v.grid).front();
    plan.reserve("surface voxels (estimated)", v.voxelCount * sizeof(gpu::VoxelMaterial));
    plan.reserve("sums (estimated)", uint64_t(v.voxelCount) * SUMS_PER_VOXEL * sizeof(uint32_t));
    method_->plan(plan, v);

    for (const Material& material : plan.frame.scene->scene->materials)
        for (int c = 0; c < 3; ++c) largestEmission_ = std::max(largestEmission_, material.emission[c]);
}

void VoxelizePass::prepare(PassSetup& setup) {
    SurfaceVoxels& v = setup.get(voxels_);
    v.occupancy = Buffer(setup.device, "voxel occupancy", v.words() * sizeof(uint32_t));
    v.rank = Buffer(setup.device, "voxel ranks", v.words() * sizeof(uint32_t));
    method_->prepare(setup);
    resolve_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/voxelize/resolve.comp"));
    prefixSum_.emplace(setup.device, setup.compiler);
    exposureProbe_ = ExposureProbe(setup.device, setup.compiler);
}

void VoxelizePass::record(PassContext& context) {
    SurfaceVoxels& v = context.get(voxels_);

    // Mark occupied voxels, then number them.
    context.stream.fill(v.occupancy, 0);
    method_->run(context, v, {true, &v.occupancy, 0});
    v.voxelCount = prefixSum_->run(context.stream, v.occupancy, v.rank, uint32_t(v.words()));
    if (v.voxelCount == 0)
        throw Error(
            "voxelize: no surface meets the grid of {}x{}x{} voxels; the scene needs triangles with an area, "
            "and "
            "three_axis more 'samples'",
            v.grid.resolution.x, v.grid.resolution.y, v.grid.resolution.z);
    v.materials =
        Buffer(context.device, "voxel materials", uint64_t(v.voxelCount) * sizeof(gpu::VoxelMaterial));

    // Sum up what surfaces carry, in fixed point, and turn sums into averages.
    const Buffer sums(context.device, "voxelization sums",
                      uint64_t(v.voxelCount) * SUMS_PER_VOXEL * sizeof(uint32_t));
    context.stream.fill(sums, 0);
    method_->run(context, v, {false, &sums, largestEmission_ > 0 ? 1.0f / largestEmission_ : 0.0f});
    const Buffer probes = exposureProbe_.run(context, v, params_.exposureRays);
    context.stream.dispatch(resolve_, {{"sums", sums}, {"materials", v.materials}, {"probes", probes}},
                            ResolvePush{v.voxelCount, largestEmission_}, linearGroups(v.voxelCount));
    context.stream.finish();
}

std::vector<Binding> stepBindings(const PassContext& context, const SurfaceVoxels& voxels,
                                  const VoxelizeStep& step, std::initializer_list<Binding> more) {
    std::vector<Binding> bindings = context.scene.bindings(more);
    if (step.mark) {
        bindings.emplace_back("occupancy", *step.target);
    } else {
        bindings.emplace_back("sums", *step.target);
        bindings.emplace_back("voxelOccupancy", voxels.occupancy);
        bindings.emplace_back("voxelRank", voxels.rank);
    }
    return bindings;
}

}  // namespace voxray
