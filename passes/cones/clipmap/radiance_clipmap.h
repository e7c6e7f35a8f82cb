#pragma once

#include <array>
#include <string>
#include <vector>

#include "passes/cones/clipmap/clipmap_windows.h"
#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

enum class LevelDistance { Axis, Euclidean };
template <>
struct EnumNames<LevelDistance> {
    static constexpr std::array names{std::pair{LevelDistance::Axis, "axis"},
                                      std::pair{LevelDistance::Euclidean, "euclidean"}};
};

/// Parameter of a pass that fills a radiance clipmap; it adds schema() to its own with std::tuple_cat.
struct ClipmapLevelParams {
    LevelDistance levelDistance = LevelDistance::Axis;
    static constexpr auto schema() {
        return std::tuple{field("level_distance", &ClipmapLevelParams::levelDistance,
                                "The distance from the camera by which coarser levels of a clipmap replace finer ones. "
                                "axis: that along the axis where it is largest, so that all of a window counts. "
                                "euclidean: as published in Arnebäck 2017 (section 4.2.1), for comparison: "
                                "a ball in each window counts, half of its voxels.")};
    }
};

/// Radiance voxels in a clipmap (layouts clipmap and clipmap_textures): memory, and windows that follow the
/// camera. Docs: docs/clipmap.md.
class RadianceClipmap {
 public:
    RadianceClipmap() = default;
    /// @param windowSize voxels along an axis, a power of two.
    RadianceClipmap(const gpu::RadianceGrid& grid, uint32_t windowSize) : windows_(grid, windowSize) {}

    /// Describes the memory of `radiance`, whose layout and grid are set. Sets the unit to 1 in a buffer,
    /// where values have exponents. @throws Error naming `pass` for more values than 32 bits number, or a
    /// texture that the device can't make. @param remedy in the latter case
    void plan(PassPlan& plan, const std::string& pass, RadianceVoxels& radiance,
              const std::string& remedy = "set 'layout' to clipmap") const;
    void prepare(PassSetup& setup, RadianceVoxels& radiance) const;
    /// Moves the windows to the frame's camera. Stored values remain. @return the windows, by level.
    std::vector<gpu::ClipmapWindow> moveWindows(PassContext& context, RadianceVoxels& radiance) const;
    const ClipmapWindows& windows() const { return windows_; }

 private:
    ClipmapWindows windows_;
};

}  // namespace voxray
