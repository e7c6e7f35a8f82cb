#include "passes/filter_voxels/filter_voxels.h"

#include <cmath>

#include "base/error.h"
#include "passes/common/light_sources.h"

namespace voxray {
namespace {

std::unique_ptr<RadianceStorage> makeStorage(const FilterVoxels::Params& params) {
    switch (params.layout) {
        case RadianceLayout::Dense:
            return makeDenseStorage();
        case RadianceLayout::Svo:
            return makeSvoStorage(params.eachFrame);
        case RadianceLayout::Clipmap:
            return makeClipmapStorage(params.clipmapResolution, params.eachFrame);
    }
    return nullptr;
}

/// The power of two below the scene's typical irradiance, in the middle of the range of half floats.
float radianceUnit(const SceneState& state) {
    const float typical = meanIrradiance(lightSources(state), state.geometry);
    return typical > 0 ? std::exp2(std::floor(std::log2(typical))) : 1.0f;
}

}  // namespace

FilterVoxels::FilterVoxels(const Params& params) : params_(params), storage_(makeStorage(params)) {}

void FilterVoxels::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    irradiance_ = builder.read<VoxelIrradiance>("irradiance", "light that arrives at the voxels' surfaces");
    radiance_ = builder.write<RadianceVoxels>("radiance", "light that leaves them, at all scales");
}

void FilterVoxels::plan(PassPlan& plan) {
    if (plan.get(irradiance_).eachFrame && !params_.eachFrame)
        throw Error("filter_voxels: the voxels are lit anew in each frame; set its 'each_frame: true'");
    const gpu::VoxelGrid& grid = plan.get(voxels_).grid;
    RadianceVoxels& radiance = plan.get(radiance_);
    radiance.layout = params_.layout;
    radiance.grid = {grid.origin,     grid.voxelSize,
                     grid.resolution, radianceLevels(grid.resolution),
                     grid.directions, radianceUnit(*plan.frame.scene)};
    storage_->plan(plan, plan.get(voxels_), radiance);
}

void FilterVoxels::prepare(PassSetup& setup) {
    storage_->prepare(setup, setup.get(radiance_));
}

void FilterVoxels::record(PassContext& context) {
    storage_->run(context, context.get(voxels_), context.get(irradiance_), context.get(radiance_),
                  params_.emission ? 1.0f : 0.0f);
}

std::vector<Binding> surfaceRadianceBindings(const SurfaceVoxels& voxels, const VoxelIrradiance& irradiance) {
    return {{"voxelOccupancy", voxels.occupancy},         {"voxelRank", voxels.rank},
            {"VoxelMaterialsAt", voxels.materials.at()},  {"DirectFluxAt", irradiance.direct.at()},
            {"IndirectFluxAt", irradiance.indirect.at()}, {"voxelArea", irradiance.area}};
}

}  // namespace voxray
