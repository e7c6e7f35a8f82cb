#pragma once

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "passes/common/voxels/voxels.h"

namespace voxray {

/// How samples of light that meet at one face of a voxel are merged.
enum class Write { Average, Max, MovingAverage, None };
template <>
struct EnumNames<Write> {
    static constexpr std::array names{std::pair{Write::Average, "average"}, std::pair{Write::Max, "max"},
                                      std::pair{Write::MovingAverage, "moving_average"},
                                      std::pair{Write::None, "none"}};
};

/// The parameters of a pass that writes to voxels. Derive the pass's Params from it and append
/// WriteParams::schema() to its schema with std::tuple_cat.
struct WriteParams {
    Write write = Write::Average;
    float white = 1.0f;
    static constexpr auto schema() {
        return std::tuple{
            field("write", &WriteParams::write,
                  "How light that meets in a voxel is merged: average is exact and independent of order; "
                  "max keeps the brightest sample; "
                  "moving_average is the 8-bit compare-and-swap loop of Magalhães 2020; "
                  "none stores each sample over the one before, so that whichever comes last stays: "
                  "what a write costs at least."),
            field("white", &WriteParams::white,
                  "Irradiance, W/m², that white stands for in the 8 bits of moving_average; "
                  "what is brighter is clamped.",
                  1e-6f, 1e9f)
                .onlyWith(oneOf(&WriteParams::write, {Write::MovingAverage}))};
    }
};

/// Irradiance samples, merged for each face of each voxel. A shader that writes them is compiled with
/// defines(), includes shaders/voxels/voxel_accumulator.glsl and is given bindings(). Source: Magalhães 2020,
/// sections 4.2.5.2 to 4.2.5.3 and 5.2.4.
///  - average: 64-bit fixed-point sums of weight and weighted irradiance: bit-identical in any order, exact
///  to
///    2^-24 of `typicalIrradiance` a sample. A sample counts up to 2^16 times the typical irradiance; at
///    typical brightness 2^38 samples fit a face, at that bound 2^23.
///  - max: per channel, by atomicMax on float bits.
///  - moving_average: RGBA8, the count in alpha, which stops at 255; a sample is lost after 2^16 attempts.
///  - none: one plain store; the last sample stays, whichever that is.
/// All but average know no weights: a face takes all of a sample, or none below 1/16 of its weight.
class VoxelAccumulator {
 public:
    VoxelAccumulator(ProgramOwner& owner, const WriteParams& params);

    /// @throws Error naming `pass` where the device lacks 64-bit atomics that `average` needs.
    static void plan(const PassPlan& plan, const std::string& pass, const WriteParams& params);
    /// Selects the write for a shader that includes shaders/voxels/voxel_accumulator.glsl.
    static Defines defines(Write write);

    /// Clears, allocating where there is no memory of the right size yet. @param typicalIrradiance W/m², sets
    /// the unit of the fixed-point sums: see meanIrradiance() in passes/common/lights/light_sources.h.
    void begin(Device& device, CommandStream& stream, const SurfaceVoxels& voxels, float typicalIrradiance);
    /// For the shader that writes.
    std::vector<Binding> bindings() const;
    /// Factor from W/m² to stored units, which the writing shader passes to writeIrradiance().
    float scale() const { return scale_; }

    /// Mean irradiance times unoccluded area into `flux` (VoxelIrradiance::direct or ::indirect). `area` is
    /// raised to the unoccluded area of every face that a sample fell on, and kept elsewhere: clear it before
    /// the first resolve() if faces without samples are unknown, fill it with unoccluded areas if they are
    /// dark.
    void resolve(CommandStream& stream, const SurfaceVoxels& voxels, const LargeBuffer& flux,
                 const Buffer& area) const;
    /// Frees the sums, once the stream has finished.
    void end() { sums_ = {}, weights_ = {}; }

 private:
    const WriteParams params_;
    float scale_ = 1;
    Kernel resolve_;
    Buffer sums_, weights_;
};

}  // namespace voxray
