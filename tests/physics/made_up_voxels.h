#pragma once

#include <bit>
#include <functional>
#include <vector>

#include "passes/common/compute/bit_words.h"
#include "passes/common/voxels/voxels.h"

namespace voxray::test {

/// A grid that is held whole, somewhere in space.
inline gpu::VoxelGrid madeUpGrid(glm::uvec3 resolution, float voxelSize) {
    gpu::VoxelGrid grid{};
    grid.origin = {-1.25f, 0.5f, 3.0f};
    grid.voxelSize = voxelSize;
    grid.resolution = resolution;
    grid.wordsPerRow = uint32_t(bitWords(resolution.x));
    grid.directions = 1;
    grid.windowSize = 1024;
    return grid;
}

/// Voxels made up by a test, as voxelization leaves them but for their materials.
inline SurfaceVoxels madeUpVoxels(CommandStream& stream, const gpu::VoxelGrid& grid,
                                  const std::function<bool(glm::ivec3)>& occupied) {
    static uint64_t version = 0;
    SurfaceVoxels voxels;
    voxels.grid = grid;
    voxels.version = ++version;
    std::vector<uint32_t> occupancy(voxels.words(), 0), rank(voxels.words(), 0);
    const glm::ivec3 size(grid.resolution);
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                if (occupied({x, y, z}))
                    occupancy[(size_t(z) * size_t(size.y) + size_t(y)) * grid.wordsPerRow + size_t(x) / 32] |=
                        1u << (x % 32);
    for (size_t word = 0; word < occupancy.size(); ++word) {
        rank[word] = voxels.voxelCount;
        voxels.voxelCount += uint32_t(std::popcount(occupancy[word]));
    }
    voxels.occupancy = Buffer(stream.device(), "occupancy", voxels.words() * sizeof(uint32_t));
    voxels.rank = Buffer(stream.device(), "rank", voxels.words() * sizeof(uint32_t));
    stream.upload(voxels.occupancy, occupancy);
    stream.upload(voxels.rank, rank);
    return voxels;
}

}  // namespace voxray::test
