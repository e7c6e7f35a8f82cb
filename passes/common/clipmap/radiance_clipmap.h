#pragma once

#include <string>
#include <vector>

#include "passes/common/clipmap/clipmap_windows.h"
#include "passes/common/radiance/radiance_voxels.h"

namespace voxray {

/// Radiance voxels in a clipmap: their memory, and windows that follow the camera. Docs: docs/clipmap.md.
class RadianceClipmap {
 public:
    RadianceClipmap() = default;
    /// @param side of a window, a power of two.
    RadianceClipmap(const gpu::RadianceGrid& grid, uint32_t side) : windows_(grid, side) {}

    /// Describes the memory and sets the unit: values have an exponent of their own. @throws Error naming
    /// `pass` for more values than can be numbered.
    void plan(PassPlan& plan, const std::string& pass, RadianceVoxels& radiance) const;
    /// Moves the windows to the frame's camera. What is in their slots stays as it is.
    /// @return the windows, by level.
    std::vector<gpu::ClipmapWindow> follow(PassContext& context, RadianceVoxels& radiance) const;
    const ClipmapWindows& windows() const { return windows_; }

 private:
    ClipmapWindows windows_;
};

}  // namespace voxray
