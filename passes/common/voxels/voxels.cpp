#include "passes/common/voxels/voxels.h"

#include <algorithm>
#include <bit>
#include <climits>
#include <cmath>

#include "base/error.h"
#include "passes/common/compute/bit_words.h"
#include "scene/region_split.h"

namespace voxray {

gpu::VoxelLevel wholeLevel(const gpu::VoxelGrid& grid) {
    return {grid, glm::ivec3(INT_MIN), glm::ivec3(INT_MAX)};
}

std::vector<Binding> VoxelLevels::bindings(std::vector<Binding> more) const {
    more.insert(more.begin(),
                {ifUsed({"voxelLevels", levels}), ifUsed({"voxelOccupancy", occupancy}), ifUsed({"voxelRank", rank})});
    return more;
}

std::vector<Binding> SurfaceVoxels::bindings(std::vector<Binding> more) const {
    more.insert(more.begin(), {ifUsed({"VoxelMaterialsRef", materials.ref()}), ifUsed({"grid", grid})});
    return VoxelLevels::bindings(std::move(more));
}

void VoxelIrradiance::allocate(Device& device, uint32_t voxelCount) {
    const uint64_t fluxBytes = uint64_t(voxelCount) * kFluxWords * sizeof(uint32_t);
    if (direct && direct.bytes() == fluxBytes) return;
    direct = {}, indirect = {}, area = {};  // Frees the previous ones first.
    direct = LargeBuffer(device, "voxel direct flux", fluxBytes);
    indirect = LargeBuffer(device, "voxel indirect flux", fluxBytes);
    area = Buffer(device, "voxel area", uint64_t(voxelCount) * kAreaWords * sizeof(uint32_t));
}

void requireLight(CommandStream& stream, const VoxelLevels& voxels, const VoxelIrradiance& irradiance,
                  const SceneState& scene) {
    const auto emits = [&](uint32_t material) {
        const glm::vec3 emission = scene.scene->materials[material].emission;
        return std::max({emission.x, emission.y, emission.z}) > 0;
    };
    if (std::ranges::all_of(scene.geometry.triangleMaterials, emits)) return;
    // Only a flux of 0 packs to words of 0
    const std::vector<uint32_t> direct =
        stream.readAs<uint32_t>(irradiance.direct, irradiance.direct.bytes() / sizeof(uint32_t));
    if (std::ranges::none_of(direct, [](uint32_t word) { return word != 0; }))
        throw Error(
            "no light falls on any voxel: either the lights shine past the scene, "
            "or all that they reach has another surface within one voxel ({:.3g} m); raise voxelize's 'resolution', "
            "give the part of a large scene that is looked at as 'scene.region', or set voxelize's 'visibility_rays: "
            "0'",
            voxels.grid.voxelSize);
}

gpu::VoxelGrid makeVoxelGrid(glm::vec3 boundsMin, glm::vec3 boundsMax, uint32_t resolution) {
    const glm::vec3 extent = boundsMax - boundsMin;
    const float longest = std::max({extent.x, extent.y, extent.z, 1e-6f});
    gpu::VoxelGrid grid{};
    grid.voxelSize = longest / (float(resolution) - 0.25f);
    for (int axis = 0; axis < 3; ++axis) {
        const float voxels = std::ceil(extent[axis] / grid.voxelSize + 0.25f - 1e-4f);
        grid.resolution[axis] = std::clamp(uint32_t(std::max(voxels, 1.0f)), 1u, resolution);
    }
    // Centered on the scene
    grid.origin = 0.5f * (boundsMin + boundsMax) - 0.5f * grid.voxelSize * glm::vec3(grid.resolution);
    grid.wordsPerRow = uint32_t(bitWords(grid.resolution.x));
    grid.windowSize = std::bit_ceil(resolution);
    grid.directions = 6;
    return grid;
}

double estimateVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid) {
    // A plane with the area of a voxel's face passes through |nx| + |ny| + |nz| voxels: 3/2 on average over
    // all directions
    const double voxels = 1.5 * surfaceArea(geometry) / (double(grid.voxelSize) * grid.voxelSize);
    return std::min(voxels, double(grid.resolution.x) * grid.resolution.y * grid.resolution.z);
}

}  // namespace voxray
