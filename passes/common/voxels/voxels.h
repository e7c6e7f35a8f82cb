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

/// Words of the occupancy bits of a grid's window.
inline uint64_t occupancyWords(const gpu::VoxelGrid& grid) {
    const glm::uvec3 window = windowVoxels(grid).size;
    return uint64_t(grid.wordsPerRow) * window.y * window.z;
}

/// The level that holds all of a grid.
gpu::VoxelLevel wholeLevel(const gpu::VoxelGrid& grid);

/// The voxels that surfaces pass through, of one or more levels: an occupancy bit for each voxel of each level,
/// and ranks that number the occupied ones of all levels through. No place is in two levels. GLSL access:
/// shaders/voxels/voxel_levels.glsl.
struct VoxelLevels : Resource {
    gpu::VoxelGrid grid{};  ///< Of the finest level.
    /// Areas are those of unoccluded sides of surfaces, and light on occluded sides must be ignored.
    bool areasAreUnoccluded = false;
    uint32_t voxelCount = 0;    ///< Occupied voxels; known after the voxelizing pass has run.
    double estimatedCount = 0;  ///< Estimate of it for memory; known from plan() on.
    Buffer levels;              ///< gpu::VoxelLevel each, the finest first.
    Buffer occupancy;           ///< A bit per voxel of the levels' windows, level by level.
    Buffer rank;                ///< A uint per word of `occupancy`: occupied voxels before it.
    Buffer unoccludedArea;      ///< As VoxelIrradiance::area; SurfaceVoxels have it in their materials.

    std::vector<Binding> bindings(std::vector<Binding> more = {}) const;
    std::vector<Binding> bindings(std::initializer_list<Binding> more) const {
        return bindings(std::vector<Binding>(more));
    }
};

/// Voxels of one grid, the only level, with their materials. Empty space takes two bits per voxel. GLSL access:
/// shaders/voxels/voxels.glsl.
struct SurfaceVoxels : VoxelLevels {
    LargeBuffer materials;  ///< PackedVoxelMaterial per surface voxel.

    /// Words of `occupancy`.
    uint64_t words() const { return occupancyWords(grid); }
    /// For shaders that include shaders/voxels/voxels.glsl or declare `grid`; then `more`.
    std::vector<Binding> bindings(std::vector<Binding> more = {}) const;
    std::vector<Binding> bindings(std::initializer_list<Binding> more) const {
        return bindings(std::vector<Binding>(more));
    }
    std::vector<const Buffer*> checkedBuffers() const override { return {&materials}; }
    std::vector<Elements> elements() const override {
        return {{&materials, Elements::Type::Uint32, MATERIAL_WORDS},
                {&unoccludedArea, Elements::Type::Uint32, 3 * AREA_WORDS_PER_AXIS}};
    }
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
    std::vector<Elements> elements() const override {
        return {{&direct, Elements::Type::Uint32, kFluxWords},
                {&indirect, Elements::Type::Uint32, kFluxWords},
                {&area, Elements::Type::Uint32, kAreaWords}};
    }
};

/// @throws Error if no direct light arrives at any voxel, which is a mistake in the scene unless all surfaces
/// are emissive. Waits for the device.
void requireLight(CommandStream& stream, const VoxelLevels& voxels, const VoxelIrradiance& irradiance,
                  const SceneState& scene);

/// The smallest grid of cubic voxels around a box, with `resolution` voxels along its longest axis and a
/// margin of 1/8 voxel, so that no surface is on its border.
gpu::VoxelGrid makeVoxelGrid(glm::vec3 boundsMin, glm::vec3 boundsMax, uint32_t resolution);

/// Estimates the number of voxels that surfaces pass through from their area.
double estimateVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid);

}  // namespace voxray
