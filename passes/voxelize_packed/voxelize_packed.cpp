#include "passes/voxelize_packed/voxelize_packed.h"

#include <vector>

#include "passes/common/voxels/voxels.h"

namespace voxray {

void VoxelizePacked::declare(PassBuilder& builder) {
    voxels_ = builder.write<PackedVoxels>("packed_voxels", "normals and albedos, one word a voxel");
}

void VoxelizePacked::plan(PassPlan& plan) {
    const Geometry& geometry = plan.frame.scene->geometry;
    PackedVoxels& voxels = plan.get(voxels_);
    voxels.grid = makeVoxelGrid(geometry.region.min, geometry.region.max, params_.resolution);
    plan.buffer(voxels.normals, "packed normals", voxels.bytes());
    plan.buffer(voxels.albedos, "packed albedos", voxels.bytes());
    walk_->plan(plan, voxels.grid);
}

void VoxelizePacked::prepare(PassSetup& setup) {
    walk_->prepare(setup);
    write_ = walk_->compileVisitor(setup, "passes/voxelize_packed/voxelize_packed", params_.defines());
}

void VoxelizePacked::record(PassContext& context) {
    const PackedVoxels& voxels = context.get(voxels_);
    context.stream.fill(voxels.normals, 0);
    context.stream.fill(voxels.albedos, 0);

    // Everything is drawn again each time, as published
    const VoxelRegion all(voxels.grid);
    walk_->select(context, voxels.grid, all, all.triangles(context.frame.scene->geometry));
    const std::vector<Binding> volumes{{"NormalsAt", voxels.normals.at()},
                                       {"AlbedosAt", voxels.albedos.at()}};
    walk_->run(context, write_, voxels.grid, volumes, 0);
    context.stream.finish();
    walk_->release();
}

}  // namespace voxray
