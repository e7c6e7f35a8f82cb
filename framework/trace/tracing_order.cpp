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

/// Corners' minimum plus maximum, by triangle: twice the middle of its box.
std::vector<glm::vec3> middles(const Geometry& geometry) {
    std::vector<glm::vec3> result(geometry.triangles.size());
    parallelRanges(result.size(), kParallelTriangles, [&](size_t begin, size_t end) {
        for (size_t t = begin; t < end; ++t) {
            const glm::uvec3 v = geometry.triangles[t];
            const glm::vec3 &a = geometry.positions[v.x], &b = geometry.positions[v.y];
            const glm::vec3& c = geometry.positions[v.z];
            result[t] = glm::min(glm::min(a, b), c) + glm::max(glm::max(a, b), c);
        }
    });
    return result;
}

/// Splits a list into halves (the first the larger), neighbours together; ties go by number, so that the
/// outcome does not depend on threads.
std::pair<std::span<uint32_t>, std::span<uint32_t>> halve(std::span<uint32_t> triangles,
                                                          const std::vector<glm::vec3>& middles) {
    glm::vec3 low = middles[triangles[0]], high = low;
    for (uint32_t t : triangles) {
        low = glm::min(low, middles[t]);
        high = glm::max(high, middles[t]);
    }
    const glm::vec3 extent = high - low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    const size_t half = (triangles.size() + 1) / 2;
    std::nth_element(triangles.begin(), triangles.begin() + ptrdiff_t(half), triangles.end(),
                     [&](uint32_t a, uint32_t b) {
                         return std::pair(middles[a][axis], a) < std::pair(middles[b][axis], b);
                     });
    return {triangles.first(half), triangles.subspan(half)};
}

void sortAsTree(std::span<uint32_t> triangles, const std::vector<glm::vec3>& middles) {
    if (triangles.size() < 2) return;
    const auto halves = halve(triangles, middles);
    if (triangles.size() < kParallelTriangles) {
        sortAsTree(halves.first, middles);
        sortAsTree(halves.second, middles);
    } else {
        tbb::parallel_invoke([&] { sortAsTree(halves.first, middles); },
                             [&] { sortAsTree(halves.second, middles); });
    }
}

/// Halves until a part is small enough to be a chunk, then orders it.
void addChunks(std::span<uint32_t> triangles, uint32_t maxChunk, const std::vector<glm::vec3>& middles,
               TracingOrder& order) {
    if (triangles.empty()) return;
    if (triangles.size() <= maxChunk) {
        order.chunkFirst.push_back(uint32_t(triangles.data() - order.triangles.data()));
        sortAsTree(triangles, middles);
        return;
    }
    const auto halves = halve(triangles, middles);
    addChunks(halves.first, maxChunk, middles, order);
    addChunks(halves.second, maxChunk, middles, order);
}

}  // namespace

TracingOrder tracingOrder(const SceneState& state, uint32_t maxChunk) {
    TracingOrder order;
    std::vector<uint32_t> masked;
    const std::vector<uint32_t>& materials = state.geometry.triangleMaterials;
    for (uint32_t t = 0; t < materials.size(); ++t) {
        const bool isMasked = state.scene->materials[materials[t]].alphaMode == AlphaMode::Mask;
        (isMasked ? masked : order.triangles).push_back(t);
    }
    order.opaqueCount = uint32_t(order.triangles.size());
    order.triangles.insert(order.triangles.end(), masked.begin(), masked.end());
    const std::vector<glm::vec3> centres = middles(state.geometry);
    const std::span<uint32_t> all = order.triangles;
    addChunks(all.first(order.opaqueCount), maxChunk, centres, order);
    addChunks(all.subspan(order.opaqueCount), maxChunk, centres, order);
    return order;
}

}  // namespace voxray
