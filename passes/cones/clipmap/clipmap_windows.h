#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "base/schema.h"
#include "passes/common/voxels/voxel_box.h"
#include "passes/cones/radiance/radiance_types.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// Parameters of a pass that builds a clipmap; it adds schema() to its own with std::tuple_cat.
struct ClipmapParams {
    uint32_t clipmapResolution = 64;
    uint32_t clipmapLevels = RADIANCE_CLIPMAP_LEVELS;
    static constexpr auto schema() {
        return std::tuple{field("clipmap_resolution", &ClipmapParams::clipmapResolution,
                                "Voxels along an edge of a clipmap's window.", powersOfTwo(16, 1024)),
                          field("clipmap_levels", &ClipmapParams::clipmapLevels,
                                "Maximum levels of a clipmap. The coarsest must hold the whole scene; "
                                "cones that are wider than its voxels read these. "
                                "By default down to a single voxel; Arnebäck 2017 has 5.",
                                1u, uint32_t(RADIANCE_CLIPMAP_LEVELS))};
    }
};

/// Levels of a clipmap over a grid of `resolution` voxels. @throws Error naming `pass` if none of them holds
/// the whole grid.
uint32_t clipmapLevels(glm::uvec3 resolution, const ClipmapParams& params, const std::string& pass);

/// The grid of a level over `finest`, without the position of its window of up to `windowSize` voxels.
gpu::VoxelGrid levelGrid(const gpu::VoxelGrid& finest, uint32_t level, uint32_t windowSize);

/// Windows of a clipmap over `grid` (Panteleev 2014), around the camera: at most `windowSize` voxels of each
/// level along an axis. The windows of smaller levels are their whole grids.
class ClipmapWindows {
 public:
    ClipmapWindows() = default;
    /// @param windowSize a power of two, 16 or more.
    ClipmapWindows(const gpu::RadianceGrid& grid, uint32_t windowSize);

    /// Voxels of all windows together.
    uint64_t voxels() const { return voxels_; }
    /// The finest level whose window is its whole grid.
    uint32_t firstWhole() const { return firstWhole_; }
    uint32_t windowSize() const { return windowSize_; }
    /// The window of a level for a camera at `camera` (m).
    gpu::ClipmapWindow window(uint32_t level, const glm::vec3& camera) const;

 private:
    gpu::RadianceGrid grid_{};
    uint32_t windowSize_ = 0;
    uint32_t firstWhole_ = 0;
    uint64_t voxels_ = 0;
    std::vector<uint32_t> firstIndices_;  ///< By level.
};

/// Reported value: the number of voxels that a pass updated, because they scrolled in or changed.
constexpr const char* kUpdatedVoxels = "updated voxels";

/// The voxels in `window` that were not in `previous`, a window of the same level: up to three disjoint
/// boxes.
std::vector<VoxelBox> scrolledIn(const gpu::ClipmapWindow& previous, const gpu::ClipmapWindow& window);

}  // namespace voxray
