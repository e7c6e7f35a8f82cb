#include "passes/filter_voxels/filter_voxels.h"

#include "base/error.h"
#include "passes/common/lights/light_sources.h"

namespace voxray {

FilterVoxels::FilterVoxels(const Params& params)
    : params_(params),
      storage_(makeRadianceStorage(params.layout, params, params)),
      bounces_(params.bounceCones) {}

void FilterVoxels::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    radiance_ = builder.write<RadianceVoxels>("radiance", "light that leaves them, at all scales");
}

void FilterVoxels::plan(PassPlan& plan) {
    eachFrame_ = plan.phase == Phase::Frame;
    const gpu::VoxelGrid& grid = plan.get(voxels_).grid;
    if (params_.bounces > 0 && storage_->followsCamera())
        throw Error(
            "filter_voxels: 'bounces' needs all voxels, of which this layout holds those near the camera; "
            "set 'layout' to dense or svo, or the injection's own 'bounces', or take voxelize_clipmap and "
            "light_clipmap");
    RadianceVoxels& radiance = plan.get(radiance_);
    if (const auto injected = plan.get(irradiance_).lightBounces)
        radiance.lightBounces = *injected + params_.bounces + 1;
    radiance.layout = params_.layout;
    radiance.emission = params_.emission;
    radiance.euclidean = params_.levelDistance == LevelDistance::Euclidean;
    radiance.grid = {grid.origin,     grid.voxelSize,
                     grid.resolution, gridLevels(grid.resolution),
                     grid.directions, radianceUnit(*plan.frame.scene)};
    storage_->plan(plan, plan.get(voxels_), radiance);
    if (params_.bounces > 0) bounces_.plan(plan, plan.get(voxels_).voxelCount, eachFrame_);
}

void FilterVoxels::prepare(PassSetup& setup) {
    storage_->prepare(setup, setup.get(radiance_));
    if (params_.bounces > 0) bounces_.prepare(setup, setup.get(radiance_));
}

void FilterVoxels::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelIrradiance& irradiance = context.get(irradiance_);
    RadianceVoxels& radiance = context.get(radiance_);
    const auto fill = [&](const LargeBuffer& indirect, bool last) {
        storage_->run(context, voxels, {irradiance.direct, indirect, irradiance.area, irradiance.version},
                      radiance, last && params_.emission ? 1.0f : 0.0f);
    };

    // Each bounce carries all light of the last one on: one more of each order. What surfaces emit is not
    // in before the end, since what it does to others is direct light.
    fill(irradiance.indirect, params_.bounces == 0);
    for (uint32_t bounce = 1; bounce <= params_.bounces; ++bounce) {
        bounces_.gather(context, voxels, irradiance, radiance);
        fill(bounces_.flux(), bounce == params_.bounces);
    }
    if (eachFrame_) return;
    if (params_.bounces > 0) bounces_.release(context.stream);
    storage_->close(context.stream, radiance);
}

}  // namespace voxray
