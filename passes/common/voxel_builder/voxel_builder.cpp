#include "passes/common/voxel_builder/voxel_builder.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/voxel_builder/sums_layout.h"

namespace voxray {
namespace {

struct ResolvePush {
    uint32_t voxelCount;
    float largestEmission;
};

}  // namespace

void VoxelBuildParams::check(const std::string& pass) const {
    if (directions != 1 && directions != 6)
        throw Error("{}: directions is {}; it can be 1 or 6", pass, directions);
}

void VoxelBuilder::planVoxels(PassPlan& plan, const SurfaceVoxels& voxels) {
    plan.reserve("occupancy and ranks", voxels.words() * 2 * sizeof(uint32_t));
    plan.reserve("surface voxels (estimated)", voxels.voxelCount * sizeof(gpu::VoxelMaterial));
}

void VoxelBuilder::planWork(PassPlan& plan, const SurfaceVoxels& voxels, bool updates) {
    const uint64_t count = voxels.voxelCount;
    plan.reserveScratch("sums (estimated)", count * SUMS_PER_VOXEL * sizeof(uint32_t));
    plan.reserveScratch("exposure (estimated)", VisibilityProbe::bytes(voxels.voxelCount, visibilityRays_));
    // The voxels of a region stand beside the previous ones, at worst all of them.
    if (updates)
        plan.reserveScratch("update of a region (at most)",
                            RegionMerge::scratchBytes(voxels) + count * sizeof(gpu::VoxelMaterial));
    method_->plan(plan, voxels);
    for (const Material& material : plan.frame.scene->scene->materials)
        for (int c = 0; c < 3; ++c) largestEmission_ = std::max(largestEmission_, material.emission[c]);
}

void VoxelBuilder::prepare(PassSetup& setup) {
    method_->prepare(setup);
    resolve_ =
        makeComputeProgram(setup.device, setup.compiler.compile("passes/common/voxel_builder/resolve.comp"));
    prefixSum_.emplace(setup.device, setup.compiler);
    visibilityProbe_ = VisibilityProbe(setup.device, setup.compiler);
    join_ = RegionMerge(setup.device, setup.compiler);
}

void VoxelBuilder::build(PassContext& context, SurfaceVoxels& voxels) {
    voxelize(context, VoxelRegion(voxels.grid), voxels, nullptr);
    ++voxels.version;
}

SurfaceVoxels VoxelBuilder::update(PassContext& context, const VoxelRegion& region, SurfaceVoxels& voxels) {
    SurfaceVoxels fresh;
    fresh.grid = voxels.grid;
    fresh.unoccludedOnly = voxels.unoccludedOnly;
    voxelize(context, region, fresh, &voxels);
    join_.materials(context.stream, *prefixSum_, fresh, voxels);
    ++voxels.version;
    return fresh;
}

void VoxelBuilder::voxelize(PassContext& context, const VoxelRegion& region, SurfaceVoxels& target,
                            const SurfaceVoxels* previous) {
    CommandStream& stream = context.stream;
    if (!target.occupancy) {
        target.occupancy = Buffer(context.device, "voxel occupancy", target.words() * sizeof(uint32_t));
        target.rank = Buffer(context.device, "voxel ranks", target.words() * sizeof(uint32_t));
    }
    const std::vector<uint32_t> triangles = region.triangles(context.frame.scene->geometry);
    method_->select(context, target.grid, region, triangles);

    // Mark occupied voxels, then number them.
    stream.fill(target.occupancy, 0);
    method_->run(context, target, {true, &target.occupancy, 0});
    if (previous) join_.occupancy(stream, region, *previous, target);
    target.voxelCount = prefixSum_->run(stream, target.occupancy, target.rank, uint32_t(target.words()));
    const uint64_t count = std::max(target.voxelCount, 1u);
    target.materials = LargeBuffer(context.device, "voxel materials", count * sizeof(gpu::VoxelMaterial));
    if (target.voxelCount == 0) stream.fill(target.materials, 0);

    // Sum up what surfaces carry, in fixed point, and turn sums into averages.
    const LargeBuffer sums(context.device, "voxelization sums", count * SUMS_PER_VOXEL * sizeof(uint32_t));
    stream.fill(sums, 0);
    method_->run(context, target, {false, &sums.at(), largestEmission_ > 0 ? 1.0f / largestEmission_ : 0.0f});
    const Buffer probes = visibilityProbe_.run(context, target, triangles, visibilityRays_);
    stream.dispatch(resolve_,
                    {{"SumsAt", sums.at()}, {"VoxelMaterialsAt", target.materials.at()}, {"probes", probes}},
                    ResolvePush{target.voxelCount, largestEmission_}, linearGroups(target.voxelCount));
    stream.finish();
    method_->release();
}

}  // namespace voxray
