#include "passes/filter_voxels/dense_fill.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct SurfacePush {
    gpu::VoxelGrid grid;
    float emission;
};

}  // namespace

uint64_t voxelsOf(glm::uvec3 resolution) {
    return uint64_t(resolution.x) * resolution.y * resolution.z;
}

DenseFill::DenseFill(PassSetup& setup, const RadianceVoxels& radiance) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file, radiance.defines()));
    };
    surface_ = program("passes/filter_voxels/dense_surface.comp");
    level_ = program("passes/filter_voxels/dense_level.comp");
}

void DenseFill::run(CommandStream& stream, const SurfaceVoxels& voxels, const SurfaceLight& light,
                    const RadianceVoxels& radiance, float emission) const {
    std::vector<Binding> bindings = surfaceRadianceBindings(voxels, light);
    for (const Binding& binding : radiance.fillBindings(0)) bindings.push_back(binding);
    stream.dispatch(surface_, bindings, SurfacePush{voxels.grid, emission},
                    linearGroups(voxelsOf(radiance.grid.resolution)));
    for (uint32_t level = 1; level < radiance.grid.levels; ++level)
        stream.dispatch(level_, radiance.fillBindings(level), level,
                        linearGroups(voxelsOf(levelResolution(radiance.grid.resolution, level))));
}

}  // namespace voxray
