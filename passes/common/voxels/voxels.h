#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/voxels/voxel_box.h"
#include "shaders/voxels/voxel_packing.h"

namespace voxray {

/// The voxels of a grid's window, which may be the whole grid.
inline VoxelBox windowVoxels(const gpu::VoxelGrid& grid) {
    return {grid.first, glm::min(grid.resolution, glm::uvec3(grid.windowSize))};
}

/// The voxels that surfaces pass through: an occupancy bit for each voxel of the grid, ranks that number the
/// occupied ones, and their materials. Empty space takes two bits per voxel. GLSL access:
/// shaders/voxels/voxels.glsl.
struct SurfaceVoxels : Resource {
    gpu::VoxelGrid grid{};
    /// Areas are those of unoccluded sides of surfaces, and light on occluded sides must be ignored.
    bool areasAreUnoccluded = false;
    uint32_t voxelCount = 0;    ///< Occupied voxels; known after the voxelizing pass has run.
    double estimatedCount = 0;  ///< Estimate of it for memory; known from plan() on.
    Buffer occupancy;           ///< A bit per voxel of the grid's window.
    Buffer rank;                ///< A uint per word of `occupancy`: occupied voxels before it.
    LargeBuffer materials;      ///< PackedVoxelMaterial per surface voxel.

    /// Words of `occupancy`.
    uint64_t words() const {
        const glm::uvec3 window = windowVoxels(grid).size;
        return uint64_t(grid.wordsPerRow) * window.y * window.z;
    }
    /// For shaders that include shaders/voxels/voxels.glsl or declare `grid`; then `more`.
    std::vector<Binding> bindings(std::vector<Binding> more = {}) const;
    std::vector<Binding> bindings(std::initializer_list<Binding> more) const {
        return bindings(std::vector<Binding>(more));
    }
    std::vector<const Buffer*> checkedBuffers() const override { return {&materials}; }
};

/// Faces of a voxel: +x -x +y -y +z -z.
constexpr uint32_t kFaces = 6;
/// Words per voxel of VoxelIrradiance's flux buffers and of its area (shaders/voxels/voxel_packing.h).
constexpr uint32_t kFluxWords = 3 * FLUX_WORDS_PER_AXIS, kAreaWords = 3 * AREA_WORDS_PER_AXIS;

/// Light that arrives at each voxel's surfaces, by the voxel's faces +x -x +y -y +z -z: flux and area. Their
/// ratio is the mean irradiance; lookups interpolate both separately. Irradiance is unknown where the area is
/// 0, and lookups skip the face. GLSL access: shaders/voxels/packed_flux.glsl and voxel_irradiance.glsl.
struct VoxelIrradiance : Resource {
    std::string indexedBy() const override { return "voxels"; }

    LargeBuffer direct;    ///< W, straight from the lights: kFluxWords a voxel.
    LargeBuffer indirect;  ///< W, after one bounce or more; likewise.
    Buffer area;           ///< In units of a voxel's face: kAreaWords a voxel.
    /// Set in plan(): irradiance is known only for voxels within this distance, in voxels along each axis, of
    /// surfaces that the camera sees; nullopt: everywhere.
    std::optional<uint32_t> reach;

    static uint64_t bytes(uint32_t voxelCount) {
        return uint64_t(voxelCount) * (2 * kFluxWords + kAreaWords) * sizeof(uint32_t);
    }
    /// Reallocates the buffers if their size has changed; their content is undefined.
    void allocate(Device& device, uint32_t voxelCount);
    std::vector<const Buffer*> checkedBuffers() const override { return {&direct, &indirect, &area}; }
};

/// @throws Error if no direct light arrives at any voxel, which is a mistake in the scene unless all surfaces
/// are emissive. Waits for the device.
void requireLight(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelIrradiance& irradiance,
                  const SceneState& scene);

/// The smallest grid of cubic voxels around a box, with `resolution` voxels along its longest axis and a
/// margin of 1/8 voxel, so that no surface is on its border.
gpu::VoxelGrid makeVoxelGrid(glm::vec3 boundsMin, glm::vec3 boundsMax, uint32_t resolution);

/// Estimates the number of voxels that surfaces pass through from their area.
double estimateVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid);

}  // namespace voxray
