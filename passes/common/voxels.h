#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "graph/pass.h"
#include "shaders/shared/voxel_types.h"

namespace voxray {

/// The voxels that surfaces pass through: an occupancy bit for each voxel of the grid, ranks that number the
/// occupied ones, and their materials. Empty space costs two bits a voxel. GLSL access: shaders/voxels.glsl.
struct SurfaceVoxels : Resource {
    gpu::VoxelGrid grid{};
    bool exposedOnly =
        false;  ///< Areas count only sides with open space before them; so must what lands on them.
    uint32_t voxelCount = 0;  ///< Occupied voxels; known once the voxelizing pass has run.
    Buffer occupancy;         ///< 1 bit a voxel of the grid.
    Buffer rank;              ///< 1 uint a word of `occupancy`: occupied voxels before it.
    Buffer materials;         ///< VoxelMaterial a surface voxel.

    uint64_t words() const { return uint64_t(grid.wordsPerRow) * grid.resolution.y * grid.resolution.z; }
    std::vector<const Buffer*> checkedBuffers() const override { return {&materials}; }
};

/// Light that arrives at the surfaces of each voxel, by the side that they face: flux in W for the 6
/// directions +x -x +y -y +z -z, 3 floats each, 18 a voxel. Divided by the area that faces a direction
/// (VoxelMaterial::exposedPositive or exposedNegative, times voxelSize²) it is the mean irradiance. GLSL
/// access: shaders/voxel_irradiance.glsl.
struct VoxelIrradiance : Resource {
    Buffer direct;    ///< Straight from the lights.
    Buffer indirect;  ///< After one bounce or more.
    std::vector<const Buffer*> checkedBuffers() const override { return {&direct, &indirect}; }
};

/// The smallest grid of cubic voxels round a box, `resolution` voxels along its longest side, with an eighth
/// of a voxel to spare, so that no surface lies on its border.
gpu::VoxelGrid makeVoxelGrid(glm::vec3 boundsMin, glm::vec3 boundsMax, uint32_t resolution);

/// A guess of the number of surface voxels from the triangles' areas and edges, for predicting memory: an
/// upper bound for scenes of large triangles.
uint64_t estimateSurfaceVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid);

}  // namespace voxray
