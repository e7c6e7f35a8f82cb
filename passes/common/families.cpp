#include "passes/common/families.h"

#include <string>

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
}

}  // namespace voxray
