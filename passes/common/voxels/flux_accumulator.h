#pragma once

#include <vector>

#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Sums the flux of rays by voxel face, in 64-bit fixed point: exact to float rounding, and bit-identical in
/// any order. Shaders add to it by shaders/voxels/flux_accumulator.glsl.
class FluxAccumulator {
 public:
    explicit FluxAccumulator(ProgramOwner& owner);

    /// Allocates and clears. @param power of all lights, W: 2^56 units, so that a sum stays below 2^63 even
    /// if all of it arrives at one face in each of 64 bounces.
    void begin(Device& device, CommandStream& stream, const SurfaceVoxels& voxels, double power);
    std::vector<Binding> bindings() const;
    float unitsPerWatt() const { return unitsPerWatt_; }
    /// Writes watts to `flux` (VoxelIrradiance::direct or ::indirect).
    void resolve(CommandStream& stream, const SurfaceVoxels& voxels, const LargeBuffer& flux) const;
    /// Frees the sums, once the stream has finished.
    void end() { sums_ = {}; }

 private:
    float unitsPerWatt_ = 0;
    Kernel resolve_;
    LargeBuffer sums_;
};

}  // namespace voxray
