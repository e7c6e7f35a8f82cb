#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// A triangle's corners in grid coordinates.
inline std::array<glm::dvec3, 3> cornersInVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid,
                                                 uint32_t triangle) {
    std::array<glm::dvec3, 3> corners;
    for (int i = 0; i < 3; ++i)
        corners[size_t(i)] =
            (glm::dvec3(geometry.positions[geometry.triangles[triangle][i]]) - glm::dvec3(grid.origin)) /
            double(grid.voxelSize);
    return corners;
}

/// By how much voxels are enlarged, so that a count includes all that a voxelizer finds: their margin is up
/// to 1/2048 (grid_triangle.glsl), and their coordinates are rounded to 2^-14.
constexpr double kCountMargin = 1.0 / 1024;
/// Twice the voxelizers' rounding error of a plane, over the product of its edges' lengths.
constexpr double kCountRounding = 1e-6;

/// Calls visit(glm::ivec3) once for each voxel that may overlap a triangle, given in grid coordinates: where
/// its column along the triangle's dominant axis overlaps the triangle, at the depths of the triangle's
/// plane. That is all that exact voxelization finds, and about 1 % more. None for a triangle without area.
template <typename Visit>
void visitVoxels(glm::uvec3 resolution, const std::array<glm::dvec3, 3>& corners, const Visit& visit) {
    constexpr double margin = kCountMargin;
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const glm::dvec3 size = glm::abs(normal);
    const int w = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int u = (w + 1) % 3, v = (w + 2) % 3;
    if (size[w] <= 0) return;
    const glm::dvec3 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
    const glm::dvec3 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
    const glm::dvec3 voxels(resolution);
    const glm::ivec3 first(glm::clamp(glm::floor(low - margin), glm::dvec3(0), voxels));
    const glm::ivec3 last(glm::clamp(glm::floor(high + margin), glm::dvec3(-1), voxels - 1.0));

    // The triangle is in one voxel
    if (first == last) {
        visit(first);
        return;
    }

    // Half-planes of the edges, projected along the axis
    std::array<glm::dvec3, 3> edges;  // Outward normal along u and v, maximum of a point along it.
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3 along = corners[(i + 1) % 3] - corners[i];
        const glm::dvec2 outward = (normal[w] > 0 ? 1.0 : -1.0) * glm::dvec2(along[v], -along[u]);
        edges[i] = {outward, outward.x * corners[i][u] + outward.y * corners[i][v] +
                                 margin * (std::abs(outward.x) + std::abs(outward.y))};
    }
    const double slopeU = -normal[u] / normal[w], slopeV = -normal[v] / normal[w];
    const double length1 = glm::length(corners[1] - corners[0]), length2 = glm::length(corners[2] - corners[0]);
    const double planeError = kCountRounding * length1 * length2 / glm::length(normal) * std::max(length1, length2);
    const double reach = 0.5 * (std::abs(slopeU) + std::abs(slopeV)) + margin + planeError;
    for (int y = first[v]; y <= last[v]; ++y)
        for (int x = first[u]; x <= last[u]; ++x) {
            // A column whose nearest corner is outside an edge is skipped
            const bool outside = std::ranges::any_of(edges, [&](const glm::dvec3& e) {
                return e.x * (e.x < 0 ? x + 1 : x) + e.y * (e.y < 0 ? y + 1 : y) > e.z;
            });
            if (outside) continue;
            const double center =
                corners[0][w] + slopeU * (x + 0.5 - corners[0][u]) + slopeV * (y + 0.5 - corners[0][v]);
            // For slivers these may be NaN: then the whole depth counts
            const int from = int(std::max(double(first[w]), std::floor(center - reach)));
            const int to = int(std::min(double(last[w]), std::floor(center + reach)));
            glm::ivec3 voxel;
            voxel[u] = x;
            voxel[v] = y;
            for (voxel[w] = from; voxel[w] <= to; ++voxel[w]) visit(voxel);
        }
}

}  // namespace voxray
