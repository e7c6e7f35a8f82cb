#include "trace/tracing_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gpu/trace_scenes.h"

namespace voxray {
namespace {

bool isMasked(const SceneState& state, uint32_t triangle) {
    const uint32_t material = state.geometry.triangleMaterials[triangle];
    return state.scene->materials[material].alphaMode == AlphaMode::Mask;
}

TEST(TracingOrder, HoldsEveryTriangleOnceOpaqueOnesFirst) {
    const SceneState state = triangleSoup(1001, 0.1f, 1);
    const TracingOrder order = tracingOrder(state, 100);
    for (uint32_t i = 0; i < order.triangles.size(); ++i)
        EXPECT_EQ(isMasked(state, order.triangles[i]), i >= order.opaqueCount);
    std::vector<uint32_t> sorted = order.triangles;
    std::ranges::sort(sorted);
    ASSERT_EQ(sorted.size(), 1001u);
    for (uint32_t i = 0; i < sorted.size(); ++i) EXPECT_EQ(sorted[i], i);
}

TEST(TracingOrder, ChunksAreSmallEnoughAndDoNotMixOpaqueAndMasked) {
    const SceneState state = triangleSoup(1001, 0.1f, 1);
    const TracingOrder order = tracingOrder(state, 100);
    ASSERT_GE(order.chunkFirst.size(), 11u);
    EXPECT_EQ(order.chunkFirst[0], 0u);
    for (size_t chunk = 0; chunk < order.chunkFirst.size(); ++chunk) {
        const uint32_t first = order.chunkFirst[chunk], end = order.chunkEnd(chunk);
        EXPECT_LT(first, end);
        EXPECT_LE(end - first, 100u);
        EXPECT_TRUE(end <= order.opaqueCount || first >= order.opaqueCount);
    }
    EXPECT_EQ(order.chunkEnd(order.chunkFirst.size() - 1), 1001u);
}

TEST(TracingOrder, NeighborsOnALineStayNeighbors) {
    // Triangles along x in a shuffled order come out sorted by x.
    SceneState state = emptyScene();
    for (uint32_t i = 0; i < 64; ++i) {
        const float x = float((i * 37) % 64);
        for (const glm::vec3& corner : {glm::vec3(x, 0, 0), glm::vec3(x + 0.5f, 0, 0), glm::vec3(x, 0.5f, 0)})
            state.geometry.positions.push_back(corner);
        state.geometry.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        state.geometry.triangleMaterials.push_back(0);
    }
    const TracingOrder order = tracingOrder(state, 1000);
    for (uint32_t i = 0; i < 64; ++i) EXPECT_EQ((order.triangles[i] * 37) % 64, i);
    EXPECT_EQ(order.chunkFirst, std::vector<uint32_t>{0});
}

TEST(TracingOrder, EmptySceneHasNoChunk) {
    const TracingOrder order = tracingOrder(emptyScene(), 10);
    EXPECT_TRUE(order.triangles.empty());
    EXPECT_TRUE(order.chunkFirst.empty());
}

}  // namespace
}  // namespace voxray
