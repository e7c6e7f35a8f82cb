#include "passes/common/families.h"

#include <string>

#include "passes/path_trace/path_tracer.h"

namespace voxray {

void registerPasses(Registry& registry) {
    for (const Family& family : kFamilies) {
        const std::string folder(family.folder);
        addRegistered(registry, "passes/" + folder + "/", folder);
    }
    registry.renamed("direct_voxels", "gather_irradiance with 'light: direct'");
    registry.renamed("gather_cached_rays", "gather_rays with 'source: radiance_cache'");
    registry.renamed("gather_merged_rays", "gather_rays with 'source: merged_voxels'");
    registry.renamed("inject_gather_hits", "inject_voxel_rays with 'points: gather_hits'");
    registry.renamed("inject_shadow_map", "inject_voxel_rays with 'direct: shadow_maps'");
    registry.preview = [](const SceneState& state, const EmbreeScene& tracer, const Camera& camera,
                          uint32_t width, uint32_t height, uint32_t spp, uint32_t bounces) {
        const PathTraceOptions options{
            .width = width, .height = height, .spp = spp, .bounces = bounces, .rays = RaysToCome::Few};
        return pathTrace(state, tracer, camera, options).total;
    };
}

}  // namespace voxray
