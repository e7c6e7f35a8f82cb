#include "passes/cones/filter_voxels/dense_fill.h"

namespace voxray {

uint64_t voxelsOf(glm::uvec3 resolution) {
    return uint64_t(resolution.x) * resolution.y * resolution.z;
}

DenseFill::DenseFill(ProgramOwner& owner)
    : surface_(owner, "dense_surface.comp"), level_(owner, "passes/cones/radiance/filter_level.comp") {}

void DenseFill::plan(const RadianceVoxels& radiance) {
    for (Kernel* kernel : {&surface_, &level_}) kernel->define(radiance.defines());
}

void DenseFill::run(CommandStream& stream, const SurfaceVoxels& voxels, const SurfaceLight& light,
                    const RadianceVoxels& radiance, float emission) const {
    stream.dispatch(surface_, voxelsOf(radiance.grid.resolution),
                    {voxels, light, radiance.fillBindings(), {"emission", emission}});
    for (uint32_t level = 1; level < radiance.grid.levels; ++level)
        stream.dispatch(level_, voxelsOf(levelResolution(radiance.grid.resolution, level)),
                        {radiance.fillBindings(level), {"level", level}});
}

}  // namespace voxray
