#include "passes/common/voxels/flux_accumulator.h"

#include <algorithm>
#include <cmath>

namespace voxray {

FluxAccumulator::FluxAccumulator(ProgramOwner& owner) : resolve_(owner, "flux_accumulator_resolve.comp") {}

void FluxAccumulator::begin(Device& device, CommandStream& stream, const SurfaceVoxels& voxels,
                            double power) {
    const uint64_t sums = uint64_t(std::max(voxels.voxelCount, 1u)) * kFaces * 3;
    sums_ = LargeBuffer(device, "flux accumulator", sums * sizeof(uint64_t));
    stream.fill(sums_, 0);
    unitsPerWatt_ = float(std::ldexp(1.0, 56) / power);
}

std::vector<Binding> FluxAccumulator::bindings() const {
    return {{"FluxAccumulatorRef", sums_.ref()}};
}

void FluxAccumulator::resolve(CommandStream& stream, const SurfaceVoxels& voxels,
                              const LargeBuffer& flux) const {
    const uint32_t pairs = voxels.voxelCount * 3;
    stream.dispatch(
        resolve_, pairs,
        {*this, {"FluxRef", flux.ref()}, {"pairs", pairs}, {"wattsPerUnit", 1.0f / unitsPerWatt_}});
}

}  // namespace voxray
