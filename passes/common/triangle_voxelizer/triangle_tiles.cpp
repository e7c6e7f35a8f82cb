#include "passes/common/triangle_voxelizer/triangle_tiles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace voxray {
namespace {

constexpr int kTileSide = 8;  // Columns, as in exact.glsl.

/// Calls process(packed tile) for the tiles of a triangle's bounds that may overlap the region.
template <typename Process>
void forEachTile(const Geometry& geometry, const gpu::VoxelGrid& grid, const VoxelRegion& region, uint32_t triangle,
                 const Process& process) {
    const auto corner = [&](int k) {
        return (geometry.positions[geometry.triangles[triangle][k]] - grid.origin) / grid.voxelSize;
    };
    const glm::vec3 n = glm::abs(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    const int axis = n.x > n.y ? (n.x > n.z ? 0 : 2) : (n.y > n.z ? 1 : 2);
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    const GridBounds bounds(geometry, grid, triangle);
    const auto column = [&](float coordinate, int along) {
        return int(std::clamp(std::floor(coordinate), 0.0f, float(grid.resolution[along]) - 1));
    };
    // Tiles are aligned to the triangle, not to the region; those outside the region are skipped.
    const auto first = [&](int along) {
        const int lowest = column(bounds.low[along], along);
        return lowest + std::max(int(region.low()[along]) - lowest, 0) / kTileSide * kTileSide;
    };
    const auto last = [&](int along) { return std::min(column(bounds.high[along], along), int(region.high()[along])); };
    for (int y = first(w); y <= last(w); y += kTileSide)
        for (int x = first(u); x <= last(u); x += kTileSide) {
            glm::vec3 low = bounds.low, high = bounds.high;
            low[u] = float(x), high[u] = float(x + kTileSide);
            low[w] = float(y), high[w] = float(y + kTileSide);
            if (region.overlaps(low, high)) process(uint32_t(x) | uint32_t(y) << 10 | uint32_t(axis) << 20);
        }
}

}  // namespace

TriangleTiles::TriangleTiles(CommandStream& stream, const Geometry& geometry, const gpu::VoxelGrid& grid,
                             const VoxelRegion& region, const std::vector<uint32_t>& triangles) {
    std::vector<glm::uvec2> tiles;
    for (const uint32_t t : triangles)
        forEachTile(geometry, grid, region, t, [&](uint32_t tile) { tiles.push_back({t, tile}); });
    count_ = uint32_t(tiles.size());
    buffer_ = Buffer(stream.device(), "tiles of triangles", std::max<size_t>(tiles.size(), 1) * sizeof(glm::uvec2));
    if (!tiles.empty()) stream.upload(buffer_, tiles);
}

}  // namespace voxray
