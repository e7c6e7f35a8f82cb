#pragma once

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "passes/common/voxels/voxels.h"

namespace voxray {

/// How samples at one face of a voxel are merged.
enum class Write { Average, Max, MovingAverage, None };
template <>
struct EnumNames<Write> {
    static constexpr std::array names{std::pair{Write::Average, "average"}, std::pair{Write::Max, "max"},
                                      std::pair{Write::MovingAverage, "moving_average"},
                                      std::pair{Write::None, "none"}};
};

/// Parameters of a pass that writes samples to voxels; it adds schema() to its own with std::tuple_cat.
struct WriteParams {
    Write write = Write::Average;
    float white = 1.0f;
    static constexpr auto schema() {
        return std::tuple{
            field("write", &WriteParams::write,
                  "How samples in a voxel are merged: average, exact and independent of order; "
                  "max, the brightest sample; moving_average, the 8-bit compare-and-swap loop of Magalhães 2020; "
                  "none, the last sample, as the lower bound of the cost."),
            field("white", &WriteParams::white,
                  "Irradiance, W/m², of white in the 8 bits of moving_average; brighter samples are clamped.", 1e-6f,
                  1e9f)
                .onlyWith(oneOf(&WriteParams::write, {Write::MovingAverage}))};
    }
};

/// Merges irradiance samples by voxel face. A shader that writes samples includes
/// shaders/voxels/voxel_accumulator.glsl, is compiled with defines() and given bindings(). Source: Magalhães
/// 2020, sections 4.2.5.2 to 4.2.5.3 and 5.2.4.
///  - average: 64-bit fixed-point sums of weight and weighted irradiance: bit-identical in any order, exact
///  to
///    2^-24 of `typicalIrradiance` a sample. A sample counts up to 2^16 times the typical irradiance; at
///    typical brightness 2^38 samples fit a face, at that bound 2^23.
///  - max: per channel, by atomicMax on float bits.
///  - moving_average: RGBA8 with the count, up to 255, in alpha; a sample is lost after 2^16 attempts.
///  - none: a plain store; the last sample remains, in any order.
/// All but average ignore weights: a face takes the whole sample, or nothing for a weight below 1/16.
class VoxelAccumulator {
 public:
    VoxelAccumulator(ProgramOwner& owner, const WriteParams& params);

    /// @throws Error naming `pass` where the device lacks 64-bit atomics that `average` needs.
    static void plan(const PassPlan& plan, const std::string& pass, const WriteParams& params);
    /// For a shader that includes shaders/voxels/voxel_accumulator.glsl.
    static Defines defines(Write write);

    /// Clears the sums, and reallocates them if their size has changed. @param typicalIrradiance W/m²: the
    /// unit of fixed-point sums is 2^-24 of it (meanIrradiance() of passes/common/lights/light_sources.h).
    void begin(Device& device, CommandStream& stream, const VoxelLevels& voxels, float typicalIrradiance);
    /// For the shader that writes.
    std::vector<Binding> bindings() const;
    /// Units per W/m², to be passed to writeIrradiance().
    float scale() const { return scale_; }

    /// Writes mean irradiance times unoccluded area to `flux` (VoxelIrradiance::direct or ::indirect), and
    /// raises `area` to the unoccluded area for faces with samples. Clear `area` before the first resolve()
    /// if faces without samples are unknown; fill it with unoccluded areas if they are dark.
    void resolve(CommandStream& stream, const SurfaceVoxels& voxels, const LargeBuffer& flux, const Buffer& area) const;
    /// Frees the sums, once the stream has finished.
    void end() { sums_ = {}, weights_ = {}; }

 private:
    const WriteParams params_;
    float scale_ = 1;
    Kernel resolve_;
    LargeBuffer sums_, weights_;
};

}  // namespace voxray
