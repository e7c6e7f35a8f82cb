#include "passes/cones/filter_voxels/full_grids.h"

namespace voxray {

void FullGrids::define(const RadianceVoxels& radiance) {
    for (Kernel* kernel : {&surface_, &level_}) kernel->define(radiance.defines());
}

void FullGrids::run(PassContext& context, const SurfaceVoxels& voxels, const SurfaceLight& light,
                    RadianceVoxels& radiance, float emission) {
    context.dispatch(surface_, levelVoxels(radiance.grid.resolution, 0),
                     {voxels, light, radiance.fillBindings(), {"emission", emission}});
    for (uint32_t level = 1; level < radiance.grid.levels; ++level)
        context.dispatch(level_, levelVoxels(radiance.grid.resolution, level),
                         {radiance.fillBindings(level), {"level", level}});
}

}  // namespace voxray
