#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Sums the flux of rays by voxel face, in 64-bit fixed point: exact to float rounding, and bit-identical in
/// any order. Shaders add to it by shaders/voxels/flux_accumulator.glsl.
class FluxAccumulator {
 public:
    explicit FluxAccumulator(ProgramOwner& owner) : resolve_(owner, "flux_accumulator_resolve.comp") {}

    /// Allocates and clears. @param power of all lights, W: 2^56 units, so that a sum stays below 2^63 even
    /// if all of it arrives at one face in each of 64 bounces.
    void begin(Device& device, CommandStream& stream, const VoxelLevels& voxels, double power) {
        const uint64_t sums = uint64_t(std::max(voxels.voxelCount, 1u)) * kFaces * 3;
        sums_ = LargeBuffer(device, "flux accumulator", sums * sizeof(uint64_t));
        stream.fill(sums_, 0);
        unitsPerWatt_ = float(std::ldexp(1.0, 56) / power);
    }
    std::vector<Binding> bindings() const { return {{"FluxAccumulatorRef", sums_.ref()}}; }
    float unitsPerWatt() const { return unitsPerWatt_; }
    /// Writes watts to `flux` (VoxelIrradiance::direct or ::indirect).
    void resolve(CommandStream& stream, const VoxelLevels& voxels, const LargeBuffer& flux) const {
        const uint32_t pairs = voxels.voxelCount * 3;
        stream.dispatch(resolve_, pairs,
                        {*this, {"FluxRef", flux.ref()}, {"pairs", pairs}, {"wattsPerUnit", 1.0f / unitsPerWatt_}});
    }
    /// Frees the sums, once the stream has finished.
    void end() { sums_ = {}; }

 private:
    float unitsPerWatt_ = 0;
    Kernel resolve_;
    LargeBuffer sums_;
};

}  // namespace voxray
