#include "passes/common/voxel_builder/voxel_builder.h"

#include <algorithm>

#include "passes/common/voxel_builder/surface_accumulator.h"

namespace voxray {

VoxelBuilder::VoxelBuilder(ProgramOwner& owner, std::unique_ptr<TriangleVoxelizer> voxelizer, uint32_t visibilityRays)
    : voxelizer_(std::move(voxelizer)),
      visibilityRays_(visibilityRays),
      markVoxels_(voxelizer_->makeProgram(owner, "passes/common/voxel_builder/mark_voxels")),
      addSurfaces_(voxelizer_->makeProgram(owner, "passes/common/voxel_builder/add_surfaces")),
      resolve_(owner, "surface_accumulator_resolve.comp"),
      prefixSum_(owner, PrefixSum::Input::SetBits),
      visibilityProbe_(owner),
      merge_(owner),
      keepChildren_(owner) {}

void VoxelBuilder::planVoxels(PassPlan& plan, SurfaceVoxels& voxels) {
    plan.buffer(voxels.occupancy, "voxel occupancy", voxels.words() * sizeof(uint32_t));
    plan.buffer(voxels.rank, "voxel ranks", voxels.words() * sizeof(uint32_t));
}

void VoxelBuilder::planWork(PassPlan& plan) {
    voxelizer_->plan(plan);
    largestEmission_ = 0;
    for (const Material& material : plan.frame.scene->scene->materials)
        for (int c = 0; c < 3; ++c) largestEmission_ = std::max(largestEmission_, material.emission[c]);
}

void VoxelBuilder::build(PassContext& context, SurfaceVoxels& voxels) {
    voxelize(context, VoxelRegion(voxels.grid), voxels, [] {});
}

void VoxelBuilder::buildWithin(PassContext& context, const gpu::VoxelGrid& parentGrid, const Buffer& parents,
                               SurfaceVoxels& voxels) {
    voxelize(context, VoxelRegion(voxels.grid), voxels,
             [&] { keepChildren_.run(context.stream, voxels.grid, voxels.occupancy, parentGrid, parents); });
}

SurfaceVoxels VoxelBuilder::update(PassContext& context, const VoxelRegion& region, SurfaceVoxels& voxels) {
    SurfaceVoxels rebuilt;
    rebuilt.grid = voxels.grid;
    rebuilt.areasAreUnoccluded = voxels.areasAreUnoccluded;
    rebuilt.occupancy = Buffer(context.device, "voxel occupancy", voxels.occupancy.bytes());
    rebuilt.rank = Buffer(context.device, "voxel ranks", voxels.rank.bytes());
    voxelize(context, region, rebuilt, [&] { merge_.occupancy(context.stream, region, voxels, rebuilt); });
    merge_.materials(context.stream, prefixSum_, rebuilt, voxels);
    return rebuilt;
}

void VoxelBuilder::voxelize(PassContext& context, const VoxelRegion& region, SurfaceVoxels& target,
                            const std::function<void()>& restrict) {
    CommandStream& stream = context.stream;
    const std::vector<uint32_t> triangles = region.triangles(context.frame.scene->geometry);
    voxelizer_->select(context, target.grid, region, triangles);

    // Mark occupied voxels, then number them
    stream.fill(target.occupancy, 0);
    voxelizer_->run(context, *markVoxels_, target.grid, std::vector<Binding>{{"occupancy", target.occupancy}}, 0);
    restrict();
    target.voxelCount = prefixSum_.run(stream, target.occupancy, target.rank, uint32_t(target.words()));
    const uint64_t count = std::max(target.voxelCount, 1u);
    ensureSize(target.materials, context.device, "voxel materials", count * sizeof(gpu::PackedVoxelMaterial));
    if (target.voxelCount == 0) stream.fill(target.materials, 0);

    // Accumulate the surfaces' materials in fixed point, test their visibility, and divide sums by areas
    const LargeBuffer accumulator(context.device, "surface accumulator", count * ACCUMULATOR_UINTS * sizeof(uint32_t));
    const Buffer overflow(context.device, "overflow of the surface accumulator", sizeof(uint32_t));
    stream.fill(accumulator, 0);
    stream.fill(overflow, 0);
    voxelizer_->run(context, *addSurfaces_, target.grid,
                    std::vector<Binding>{{"SurfaceAccumulatorRef", accumulator.ref()},
                                         {"overflow", overflow},
                                         {"voxelOccupancy", target.occupancy},
                                         {"voxelRank", target.rank}},
                    largestEmission_ > 0 ? 1.0f / largestEmission_ : 0.0f);
    const Buffer visibility = visibilityProbe_.run(context, target, triangles, visibilityRays_);
    stream.dispatch(resolve_, target.voxelCount,
                    {{"SurfaceAccumulatorRef", accumulator.ref()},
                     {"VoxelMaterialsRef", target.materials.ref()},
                     {"visibility", visibility},
                     {"voxelCount", target.voxelCount},
                     {"largestEmission", largestEmission_}});
    if (stream.readAs<uint32_t>(overflow, 1)[0] != 0)
        throw Error("the surfaces in a voxel have more than {} times the area of its face: raise 'resolution'",
                    MAX_FACES);
    voxelizer_->release();
}

}  // namespace voxray
