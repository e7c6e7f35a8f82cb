#include "passes/clusters/cluster_light.h"

namespace voxray {

std::vector<Binding> gatherBindings(const ClusterVisibility& visibility, const ClusterLight& light) {
    return {{"visibilityLists", visibility.chunkAddresses},
            {"componentRadiosity", light.components},
            {"PatchRadiosityRef", light.patches.ref()}};
}

void ClusterGather::gather(CommandStream& stream, const ClusterVisibility& visibility,
                           const ClusterLight& light, const LargeBuffer& irradiance) const {
    stream.dispatch(gather_, visibility.patchCount,
                    {gatherBindings(visibility, light),
                     {"IrradianceRef", irradiance.ref()},
                     {"lists", visibility.layout},
                     {"patches", visibility.patchCount}});
}

}  // namespace voxray
