#pragma once

#include <vector>

#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Flux that rays bring to voxels, summed in 64-bit fixed point for each face: exact to float rounding, and
/// bit-identical in any order. A shader adds with shaders/voxels/flux_accumulator.glsl and
/// bindings().
class FluxAccumulator {
 public:
    explicit FluxAccumulator(ProgramOwner& owner);

    /// Allocates and clears. @param power W of all light together. It makes 2^56 units, so that even all of
    /// it in one voxel, bounced up to 64 times, stays below 2^63.
    void begin(Device& device, CommandStream& stream, const SurfaceVoxels& voxels, double power);
    std::vector<Binding> bindings() const;
    float unitsPerWatt() const { return unitsPerWatt_; }
    /// Watts into `flux` (VoxelIrradiance::direct or ::indirect).
    void resolve(CommandStream& stream, const SurfaceVoxels& voxels, const LargeBuffer& flux) const;
    /// Frees the sums, once the stream has finished.
    void end() { sums_ = {}; }

 private:
    float unitsPerWatt_ = 0;
    Kernel resolve_;
    LargeBuffer sums_;
};

}  // namespace voxray
