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

/// The voxels of a grid that are held: all of it, or a window.
inline VoxelBox heldVoxels(const gpu::VoxelGrid& grid) {
    return {grid.first, glm::min(grid.resolution, glm::uvec3(grid.windowSize))};
}

/// The voxels that surfaces pass through: an occupancy bit for each voxel of the grid, ranks that number the
/// occupied ones, and their materials. Empty space costs two bits a voxel. GLSL access:
/// shaders/voxels/voxels.glsl.
struct SurfaceVoxels : Resource {
    gpu::VoxelGrid grid{};
    /// Areas count only sides of surfaces with open space in front of them, and so must the light on them.
    bool unoccludedAreaOnly = false;
    uint32_t voxelCount = 0;    ///< Occupied voxels; known once the voxelizing pass has run.
    double estimatedCount = 0;  ///< About as many, for estimates of memory; known from plan() on.
    Buffer occupancy;           ///< 1 bit a voxel of the grid.
    Buffer rank;                ///< 1 uint a word of `occupancy`: occupied voxels before it.
    LargeBuffer materials;      ///< PackedVoxelMaterial a surface voxel.

    uint64_t words() const {
        const glm::uvec3 held = heldVoxels(grid).size;
        return uint64_t(grid.wordsPerRow) * held.y * held.z;
    }
    /// The bindings that a shader including shaders/voxels/voxels.glsl may use, and `grid`; then `more`.
    std::vector<Binding> bindings(std::vector<Binding> more = {}) const;
    std::vector<Binding> bindings(std::initializer_list<Binding> more) const {
        return bindings(std::vector<Binding>(more));
    }
    std::vector<const Buffer*> checkedBuffers() const override { return {&materials}; }
};

/// Faces of a voxel: +x -x +y -y +z -z.
constexpr uint32_t kFaces = 6;
/// Words that VoxelIrradiance's flux buffers hold for each voxel, and its area
/// (shaders/voxels/voxel_packing.h).
constexpr uint32_t kFluxWords = 3 * FLUX_WORDS_PER_AXIS, kAreaWords = 3 * AREA_WORDS_PER_AXIS;

/// Light that arrives at the surfaces of each voxel, by the voxel's faces +x -x +y -y +z -z: flux, and the
/// area that it fell on. Their ratio is the mean irradiance; kept apart, a lookup can interpolate both. Where
/// the area is 0 the injection did not look: nothing is known, and lookups skip the face. GLSL access:
/// shaders/voxels/packed_flux.glsl and voxel_irradiance.glsl.
struct VoxelIrradiance : Resource {
    std::string indexedBy() const override { return "voxels"; }

    LargeBuffer direct;    ///< W, straight from the lights: kFluxWords a voxel.
    LargeBuffer indirect;  ///< W, after one bounce or more; likewise.
    Buffer area;           ///< In units of a voxel's face: kAreaWords a voxel.
    /// Of voxels that lie as many along each axis round what the camera sees alone; nullopt: no such bound.
    /// Set in plan().
    std::optional<uint32_t> reach;

    static uint64_t bytes(uint32_t voxelCount) {
        return uint64_t(voxelCount) * (2 * kFluxWords + kAreaWords) * sizeof(uint32_t);
    }
    /// Before light is measured: makes the buffers where they don't have the right size; their content is
    /// undefined.
    void allocate(Device& device, uint32_t voxelCount);
    std::vector<const Buffer*> checkedBuffers() const override { return {&direct, &indirect, &area}; }
};

/// Darkness everywhere is a mistake in the set-up, not a picture, but where all surfaces emit light: they may
/// light none. @throws Error where no direct light arrives at any voxel. Waits for the device.
void requireLight(CommandStream& stream, const SurfaceVoxels& voxels, const VoxelIrradiance& irradiance,
                  const SceneState& scene);

/// The smallest grid of cubic voxels round a box, `resolution` voxels along its longest side, with an eighth
/// of a voxel to spare, so that no surface lies on its border.
gpu::VoxelGrid makeVoxelGrid(glm::vec3 boundsMin, glm::vec3 boundsMax, uint32_t resolution);

/// About how many voxels of a grid surfaces pass through, by their area.
double estimateVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid);

}  // namespace voxray
