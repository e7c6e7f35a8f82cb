#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "scene/geometry.h"

namespace voxray {

/// The order in which the GPU tracers hold a scene's triangles: opaque ones first, those with an alpha mask
/// last, both in chunks of neighbours, those that move apart from those that stay. Within a chunk triangles
/// follow the leaves of a tree that halves them along the longest axis: software Vulkan builds its trees by
/// halving the list as it stands, so that this order is the quality of its tree (17 times the speed on the
/// Stanford dragon). GPUs sort for themselves.
struct TracingOrder {
    std::vector<uint32_t> triangles;  ///< Numbers in the scene.
    std::vector<uint32_t>
        chunkFirst;  ///< Place in `triangles` of each chunk's first; none for an empty scene.
    uint32_t opaqueCount = 0;
    uint32_t maxChunk = 0;  ///< Most triangles of a chunk.

    /// Places in `triangles` of those that move: opaque ones, masked ones.
    struct Range {
        uint32_t first = 0, end = 0;
    };
    std::array<Range, 2> moving;

    bool moves(size_t chunk) const {
        return std::any_of(moving.begin(), moving.end(), [&](const Range& range) {
            return chunkFirst[chunk] >= range.first && chunkFirst[chunk] < range.end;
        });
    }
    /// Place after a chunk's last triangle.
    uint32_t chunkEnd(size_t chunk) const {
        return chunk + 1 < chunkFirst.size() ? chunkFirst[chunk + 1] : uint32_t(triangles.size());
    }
};

/// @param maxChunk most triangles of a chunk, at least 1.
TracingOrder tracingOrder(const SceneState& state, uint32_t maxChunk);

/// Sorts the triangles that move by where they are now; chunks keep their places and sizes.
void sortMoving(const SceneState& state, TracingOrder& order);

}  // namespace voxray
