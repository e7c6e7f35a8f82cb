#include "passes/common/flux_sums.h"

#include <algorithm>
#include <cmath>

#include "passes/common/dispatch.h"

namespace voxray {
namespace {

struct ResolvePush {
    uint32_t count;
    float wattsPerUnit;
};

}  // namespace

FluxSums::FluxSums(Device& device, const ShaderCompiler& compiler)
    : resolve_(makeComputeProgram(device, compiler.compile("passes/common/flux_sums_resolve.comp"))) {}

void FluxSums::begin(Device& device, CommandStream& stream, const SurfaceVoxels& voxels, double power) {
    sums_ = LargeBuffer(device, "flux sums", std::max(voxels.voxelCount, 1u) * kBytesPerVoxel);
    stream.fill(sums_, 0);
    unitsPerWatt_ = float(std::ldexp(1.0, 56) / power);
}

std::vector<Binding> FluxSums::bindings() const {
    return {{"FluxSumsAt", sums_.at()}};
}

void FluxSums::resolve(CommandStream& stream, const SurfaceVoxels& voxels, const LargeBuffer& flux) const {
    const uint32_t values = voxels.voxelCount * kFluxFloats;
    stream.dispatch(resolve_, {{"FluxSumsAt", sums_.at()}, {"FluxAt", flux.at()}},
                    ResolvePush{values, 1.0f / unitsPerWatt_}, linearGroups(values));
}

}  // namespace voxray
