#include "trace/tracing_order.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <glm/common.hpp>
#include <span>
#include <utility>

#include "base/parallel.h"

namespace voxray {
namespace {

constexpr size_t kParallelTriangles = 8192;

/// Twice the centers of the bounding boxes of the listed triangles, by triangle of the scene.
std::vector<glm::vec3> centers(const Geometry& geometry, std::span<const uint32_t> triangles) {
    std::vector<glm::vec3> result(geometry.triangles.size());
    parallelRanges(triangles.size(), kParallelTriangles, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const glm::uvec3 v = geometry.triangles[triangles[i]];
            const glm::vec3 &a = geometry.positions[v.x], &b = geometry.positions[v.y];
            const glm::vec3& c = geometry.positions[v.z];
            result[triangles[i]] = glm::min(glm::min(a, b), c) + glm::max(glm::max(a, b), c);
        }
    });
    return result;
}

/// Splits a list at the median along its longest axis (the first half is the larger). Ties are broken by
/// index, so that the result doesn't depend on threads.
std::pair<std::span<uint32_t>, std::span<uint32_t>> halve(std::span<uint32_t> triangles,
                                                          const std::vector<glm::vec3>& centers) {
    glm::vec3 low = centers[triangles[0]], high = low;
    for (uint32_t t : triangles) {
        low = glm::min(low, centers[t]);
        high = glm::max(high, centers[t]);
    }
    const glm::vec3 extent = high - low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    const size_t half = (triangles.size() + 1) / 2;
    std::nth_element(
        triangles.begin(), triangles.begin() + ptrdiff_t(half), triangles.end(),
        [&](uint32_t a, uint32_t b) { return std::pair(centers[a][axis], a) < std::pair(centers[b][axis], b); });
    return {triangles.first(half), triangles.subspan(half)};
}

void sortAsTree(std::span<uint32_t> triangles, const std::vector<glm::vec3>& centers) {
    if (triangles.size() < 2) return;
    const auto halves = halve(triangles, centers);
    if (triangles.size() < kParallelTriangles) {
        sortAsTree(halves.first, centers);
        sortAsTree(halves.second, centers);
    } else {
        tbb::parallel_invoke([&] { sortAsTree(halves.first, centers); }, [&] { sortAsTree(halves.second, centers); });
    }
}

/// Splits a range recursively into chunks and sorts each. The sizes of chunks depend only on the number of
/// triangles. @return the first index of each chunk.
std::vector<uint32_t> sortIntoChunks(TracingOrder& order, const TracingOrder::Range& range,
                                     const std::vector<glm::vec3>& centers) {
    std::vector<uint32_t> chunkFirst;
    const auto split = [&](const auto& self, std::span<uint32_t> list) -> void {
        if (list.empty()) return;
        if (list.size() <= order.maxChunk) {
            chunkFirst.push_back(uint32_t(list.data() - order.triangles.data()));
            sortAsTree(list, centers);
            return;
        }
        const auto halves = halve(list, centers);
        self(self, halves.first);
        self(self, halves.second);
    };
    split(split, std::span(order.triangles).subspan(range.first, range.end - range.first));
    return chunkFirst;
}

}  // namespace

TracingOrder tracingOrder(const SceneState& state, uint32_t maxChunk) {
    const Geometry& geometry = state.geometry;
    std::vector<bool> moves(geometry.triangles.size());
    for (const InstanceRange& range : movingInstanceRanges(geometry))
        std::fill_n(moves.begin() + ptrdiff_t(range.firstTriangle), range.triangleCount, true);

    // Opaque static, opaque moving, masked static, masked moving.
    TracingOrder order;
    order.maxChunk = maxChunk;
    std::array<TracingOrder::Range, 4> groups;
    for (uint32_t group = 0; group < 4; ++group) {
        groups[group].first = uint32_t(order.triangles.size());
        for (uint32_t t = 0; t < geometry.triangles.size(); ++t) {
            const Material& material = state.scene->materials[geometry.triangleMaterials[t]];
            const bool isMasked = material.alphaMode == AlphaMode::Mask;
            if (group == (isMasked ? 2u : 0u) + (moves[t] ? 1u : 0u)) order.triangles.push_back(t);
        }
        groups[group].end = uint32_t(order.triangles.size());
    }
    order.opaqueCount = groups[1].end;
    order.moving = {groups[1], groups[3]};

    const std::vector<glm::vec3> triangleCenters = centers(geometry, order.triangles);
    for (const TracingOrder::Range& group : groups) {
        const std::vector<uint32_t> chunks = sortIntoChunks(order, group, triangleCenters);
        order.chunkFirst.insert(order.chunkFirst.end(), chunks.begin(), chunks.end());
    }
    return order;
}

void sortMoving(const SceneState& state, TracingOrder& order) {
    for (const TracingOrder::Range& range : order.moving) {
        const auto triangles = std::span(order.triangles).subspan(range.first, range.end - range.first);
        if (!triangles.empty()) sortIntoChunks(order, range, centers(state.geometry, triangles));
    }
}

}  // namespace voxray
