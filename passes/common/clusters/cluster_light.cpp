#include "passes/common/clusters/cluster_light.h"

#include "passes/common/compute/dispatch.h"

namespace voxray {
namespace {

struct Push {
    uint32_t faces;
    uint32_t raysPerFace;
    uint32_t sideTargets;
};

}  // namespace

ClusterGather::ClusterGather(Device& device, const ShaderCompiler& compiler)
    : gather_(makeComputeProgram(device, compiler.compile("passes/common/clusters/cluster_gather.comp"))) {}

void ClusterGather::gather(CommandStream& stream, const ClusterVisibility& visibility,
                           const ClusterLight& light, const LargeBuffer& irradiance) const {
    for (const ClusterVisibility::Chunk& chunk : visibility.chunks)
        stream.dispatch(gather_,
                        {{"faces", chunk.faces},
                         {"first", chunk.first},
                         {"seen", chunk.seen},
                         {"partRadiosity", light.parts},
                         {"SideRadiosityAt", light.sides.at()},
                         {"IrradianceAt", irradiance.at()}},
                        Push{chunk.count, visibility.rays, visibility.sideTargets},
                        linearGroups(chunk.count));
}

}  // namespace voxray
