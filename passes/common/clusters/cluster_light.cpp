#include "passes/common/clusters/cluster_light.h"

#include "passes/common/compute/bindings.h"
#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct Push {
    gpu::SeenLayout lists;
    uint32_t patches;
};

}  // namespace

std::vector<Binding> gatherBindings(const ClusterVisibility& visibility, const ClusterLight& light,
                                    std::initializer_list<Binding> more) {
    return joined({{"seenChunks", visibility.addresses},
                   {"partRadiosity", light.parts},
                   {"PatchRadiosityAt", light.patches.at()}},
                  more);
}

ClusterGather::ClusterGather(Device& device, const ShaderCompiler& compiler)
    : gather_(makeComputeProgram(device, compiler.compile("passes/common/clusters/cluster_gather.comp"))) {}

void ClusterGather::gather(CommandStream& stream, const ClusterVisibility& visibility,
                           const ClusterLight& light, const LargeBuffer& irradiance) const {
    stream.dispatch(gather_, gatherBindings(visibility, light, {{"IrradianceAt", irradiance.at()}}),
                    Push{visibility.layout, visibility.patchCount}, linearGroups(visibility.patchCount));
}

}  // namespace voxray
