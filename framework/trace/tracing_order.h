#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "scene/geometry.h"

namespace voxray {

/// Order of a scene's triangles in the GPU tracers: opaque static, opaque moving, masked static, masked
/// moving ones, each in spatially compact chunks. Within a chunk triangles have the order of the leaves of a
/// tree by object median splits along the longest axis: software Vulkan builds its BVH by halving the list as
/// it is, so that this order determines its quality (17 times the speed on the Stanford dragon). GPU drivers
/// sort on their own.
struct TracingOrder {
    std::vector<uint32_t> triangles;   ///< Triangles of the scene.
    std::vector<uint32_t> chunkFirst;  ///< Indices into `triangles`; empty for an empty scene.
    uint32_t opaqueCount = 0;
    uint32_t maxChunk = 0;  ///< Maximum number of triangles in a chunk.

    /// Indices into `triangles` of moving triangles: opaque ones, masked ones.
    struct Range {
        uint32_t first = 0, end = 0;
    };
    std::array<Range, 2> moving;

    bool moves(size_t chunk) const {
        return std::any_of(moving.begin(), moving.end(), [&](const Range& range) {
            return chunkFirst[chunk] >= range.first && chunkFirst[chunk] < range.end;
        });
    }
    /// Index after a chunk's last triangle.
    uint32_t chunkEnd(size_t chunk) const {
        return chunk + 1 < chunkFirst.size() ? chunkFirst[chunk + 1] : uint32_t(triangles.size());
    }
};

/// @param maxChunk maximum number of triangles in a chunk, at least 1.
TracingOrder tracingOrder(const SceneState& state, uint32_t maxChunk);

/// Sorts moving triangles by their current positions; chunks keep their ranges.
void sortMoving(const SceneState& state, TracingOrder& order);

}  // namespace voxray
