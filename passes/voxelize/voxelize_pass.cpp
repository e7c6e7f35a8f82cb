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
    const uint64_t materials = v.voxelCount * sizeof(gpu::VoxelMaterial);
    plan.reserve("surface voxels (estimated)", materials);
    plan.reserveScratch("sums (estimated)", uint64_t(v.voxelCount) * SUMS_PER_VOXEL * sizeof(uint32_t));
    plan.reserveScratch("exposure (estimated)", ExposureProbe::bytes(v.voxelCount, params_.exposureRays));
    // The voxels of a region stand beside the former ones, at worst all of them.
    if (!movingRuns(geometry).empty())
        plan.reserveScratch("update of a region (at most)", RegionJoin::scratchBytes(v) + materials);
    method_->plan(plan, v);

    for (const Material& material : plan.frame.scene->scene->materials)
        for (int c = 0; c < 3; ++c) largestEmission_ = std::max(largestEmission_, material.emission[c]);
}

void VoxelizePass::prepare(PassSetup& setup) {
    SurfaceVoxels& v = setup.get(voxels_);
    v.occupancy = Buffer(setup.device, "voxel occupancy", v.words() * sizeof(uint32_t));
    v.rank = Buffer(setup.device, "voxel ranks", v.words() * sizeof(uint32_t));
    v.materials = {};
    method_->prepare(setup);
    resolve_ = makeComputeProgram(setup.device, setup.compiler.compile("passes/voxelize/resolve.comp"));
    prefixSum_.emplace(setup.device, setup.compiler);
    exposureProbe_ = ExposureProbe(setup.device, setup.compiler);
    join_ = RegionJoin(setup.device, setup.compiler);
}

void VoxelizePass::record(PassContext& context) {
    SurfaceVoxels& v = context.get(voxels_);
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    if (!changed || !v.materials) {
        voxelize(context, VoxelRegion(v.grid), v);
        ++v.version;
    } else if (!changed->empty()) {
        update(context, VoxelRegion(v.grid, *changed), v);
        ++v.version;
    }
    if (v.voxelCount == 0)
        throw Error(
            "voxelize: no surface meets the grid of {}x{}x{} voxels; the scene needs triangles with an area, "
            "and "
            "three_axis more 'samples'",
            v.grid.resolution.x, v.grid.resolution.y, v.grid.resolution.z);
}

void VoxelizePass::update(PassContext& context, const VoxelRegion& region, SurfaceVoxels& v) {
    SurfaceVoxels fresh;
    fresh.grid = v.grid;
    fresh.occupancy = Buffer(context.device, "new voxels", v.occupancy.bytes());
    fresh.rank = Buffer(context.device, "new voxels' ranks", v.rank.bytes());
    voxelize(context, region, fresh, &v);
    join_.materials(context.stream, *prefixSum_, fresh, v);
}

void VoxelizePass::voxelize(PassContext& context, const VoxelRegion& region, SurfaceVoxels& target,
                            const SurfaceVoxels* former) {
    CommandStream& stream = context.stream;
    const std::vector<uint32_t> triangles = region.triangles(context.frame.scene->geometry);
    method_->select(context, target.grid, region, triangles);

    // Mark occupied voxels, then number them.
    stream.fill(target.occupancy, 0);
    method_->run(context, target, {true, &target.occupancy, 0});
    if (former) join_.occupancy(stream, region, *former, target);
    target.voxelCount = prefixSum_->run(stream, target.occupancy, target.rank, uint32_t(target.words()));
    const uint64_t count = std::max(target.voxelCount, 1u);
    target.materials = LargeBuffer(context.device, "voxel materials", count * sizeof(gpu::VoxelMaterial));

    // Sum up what surfaces carry, in fixed point, and turn sums into averages.
    const LargeBuffer sums(context.device, "voxelization sums", count * SUMS_PER_VOXEL * sizeof(uint32_t));
    stream.fill(sums, 0);
    method_->run(context, target, {false, &sums.at(), largestEmission_ > 0 ? 1.0f / largestEmission_ : 0.0f});
    const Buffer probes = exposureProbe_.run(context, target, triangles, params_.exposureRays);
    stream.dispatch(resolve_,
                    {{"SumsAt", sums.at()}, {"VoxelMaterialsAt", target.materials.at()}, {"probes", probes}},
                    ResolvePush{target.voxelCount, largestEmission_}, linearGroups(target.voxelCount));
    stream.finish();
    method_->release();
}

}  // namespace voxray
