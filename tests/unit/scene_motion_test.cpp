#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "scene/moving_spheres.h"
#include "scene/shapes.h"
#include "scene_gltf_builder.h"

namespace voxray::test {
namespace {

/// A floor, and spheres on nodes below each other whose animation has everything: a spline, turns, a scale
/// that mirrors, a step, and a light and a camera that ride along.
std::shared_ptr<const Scene> jumble() {
    SceneBuilder b("jumble");
    const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
    b.quad("floor", {-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, grey);
    const uint32_t sphere = b.mesh(sphereMesh("sphere", {0.3f, 0, 0}, 0.2f, 1, grey, false, true));
    Scene& scene = b.scene();
    scene.nodes.resize(4);
    for (int32_t i = 1; i < 4; ++i) scene.nodes[size_t(i)].parent = i - 1;
    scene.nodes[1].translation = {0.5f, 0, 0};
    for (int32_t i = 0; i < 4; ++i) b.place(sphere, i);
    b.quad("shelf", {-1, 2, -1}, {0, 0, 2}, {2, 0, 0}, grey);
    using enum AnimatedProperty;
    scene.animation = {
        {0,
         Translation,
         Interpolation::CubicSpline,
         {0, 1, 3},
         {{0, 0, 0, 0},
          {0, 1, 0, 0},
          {9, 0, 0, 0},
          {0, 4, 0, 0},
          {1, 1, 0, 0},
          {0, 4, 2, 0},
          {0, 0, 0, 0},
          {0, 1, 0, 0},
          {0, 0, 0, 0}}},
        {1, Rotation, Interpolation::Linear, {0, 1.5f, 3}, {{0, 0, 0, 1}, {0, 0.6f, 0, 0.8f}, {0, 0, 0, 1}}},
        {2, Scale, Interpolation::Linear, {0, 2, 3}, {{1, 1, 1, 0}, {-2, 1, 1, 0}, {1, 1, 1, 0}}},
        {3, Translation, Interpolation::Step, {0, 1}, {{0, 0, 0, 0}, {0, 0, 1, 0}}}};
    b.pointLight({0, 3, 0}, glm::vec3(1));
    b.camera({0, 1, 4}, {0, 1, 0}, 40);
    scene.lights[0].node = 1;
    scene.cameras[0].node = 0;
    return b.finish();
}

template <typename T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST(Motion, AdvancedStateEqualsOneEvaluatedThere) {
    const auto scene = jumble();
    SceneState state = evaluate(scene, 0.4, Playback::Looping);
    std::vector<glm::vec3> before = state.geometry.positions;
    for (const double time : {0.9, 1.7, 2.9, 7.0, -0.1}) {
        const std::vector<Box> changed = advance(state, time);
        const SceneState there = evaluate(scene, time, Playback::Looping);
        EXPECT_TRUE(sameBytes(state.geometry.positions, there.geometry.positions)) << time;
        EXPECT_TRUE(sameBytes(state.geometry.attributes, there.geometry.attributes)) << time;
        EXPECT_TRUE(sameBytes(state.geometry.triangles, there.geometry.triangles)) << time;
        EXPECT_EQ(state.geometry.boundsMin, there.geometry.boundsMin);
        EXPECT_EQ(state.geometry.boundsMax, there.geometry.boundsMax);
        EXPECT_EQ(state.lights[0].position, there.lights[0].position);
        EXPECT_EQ(state.cameras[0].position, there.cameras[0].position);
        EXPECT_NE(before, state.geometry.positions);

        // Two boxes a sphere, tight round where it was and is; none for what stays.
        ASSERT_EQ(changed.size(), 8u);
        for (size_t i = 0; i < 8; ++i) {
            const InstanceRange& range = state.geometry.instances[1 + i / 2];
            const std::vector<glm::vec3>& positions = i % 2 == 0 ? before : state.geometry.positions;
            Box tight{positions[range.firstVertex], positions[range.firstVertex]};
            for (uint32_t v = 1; v < range.vertexCount; ++v)
                tight = {glm::min(tight.min, positions[range.firstVertex + v]),
                         glm::max(tight.max, positions[range.firstVertex + v])};
            EXPECT_EQ(changed[i].min, tight.min);
            EXPECT_EQ(changed[i].max, tight.max);
        }
        before = state.geometry.positions;
    }
}

TEST(Motion, BoundsHoldTheWholeMotion) {
    const auto scene = jumble();
    const Geometry looping = evaluate(scene, 0, Playback::Looping).geometry;
    Box all{looping.boundsMax, looping.boundsMin};
    for (int i = 0; i < 300; ++i) {
        const Geometry g = evaluate(scene, 0.01 * i, Playback::Frozen).geometry;
        all = {glm::min(all.min, g.boundsMin), glm::max(all.max, g.boundsMax)};
    }
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(looping.boundsMin[axis], all.min[axis]);
        EXPECT_GE(looping.boundsMax[axis], all.max[axis]);
    }
}

TEST(Motion, FrozenSceneStaysWithItsOwnBounds) {
    const auto scene = jumble();
    SceneState state = evaluate(scene, 1);
    const std::vector<glm::vec3> before = state.geometry.positions;
    for (const InstanceRange& range : state.geometry.instances) EXPECT_FALSE(range.moves);
    EXPECT_TRUE(advance(state, 1).empty());
    EXPECT_EQ(state.geometry.positions, before);
    const SceneState looping = evaluate(scene, 1, Playback::Looping);
    EXPECT_EQ(looping.geometry.positions, before);
    EXPECT_LT(looping.geometry.boundsMin.x, state.geometry.boundsMin.x);
}

TEST(Motion, RunsOfMovingInstancesAreOneRange) {
    const Geometry g = evaluate(jumble(), 0, Playback::Looping).geometry;
    const std::vector<InstanceRange> runs = movingInstanceRanges(g);
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_EQ(runs[0].firstTriangle, 2u);
    EXPECT_EQ(runs[0].triangleCount, 4 * 80u);
    EXPECT_EQ(runs[0].firstVertex, 4u);
    EXPECT_EQ(runs[0].vertexCount + 8, g.positions.size());
}

TEST(Motion, SpheresSwingAsALattice) {
    for (const auto& [count, side, layers] : {std::tuple{1, 1, 1}, {9, 3, 1}, {27, 3, 3}, {64, 4, 4}, {125, 5, 5}}) {
        Scene scene;
        MovingSpheres spheres;
        spheres.count = uint32_t(count);
        spheres.radius = 0.1f;
        spheres.center = {1, 2, 3};
        spheres.spacing = 0.5f;
        spheres.swing = {2, 0, -1};
        spheres.period = 8;
        addMovingSpheres(scene, spheres);
        ASSERT_EQ(scene.instances.size(), size_t(count));

        // The corners of an icosahedron that was split thrice are within 0.1 % of the sphere's box.
        const glm::vec3 half = 0.25f * glm::vec3(side - 1, layers - 1, side - 1) + 0.1f;
        const auto shared = std::make_shared<const Scene>(scene);
        const auto expectBounds = [&](double time, const glm::vec3& shift) {
            const Geometry g = evaluate(shared, time).geometry;
            expectNear(g.boundsMin, spheres.center + shift - half, 2e-3f);
            expectNear(g.boundsMax, spheres.center + shift + half, 2e-3f);
        };
        expectBounds(0, {0, 0, 0});
        expectBounds(1, {1, 0, -0.5f});
        expectBounds(2, spheres.swing);
        expectBounds(6, -spheres.swing);
        const Geometry looping = evaluate(shared, 3, Playback::Looping).geometry;
        expectNear(looping.boundsMin, spheres.center - glm::abs(spheres.swing) - half, 2e-3f);
        expectNear(looping.boundsMax, spheres.center + glm::abs(spheres.swing) + half, 2e-3f);
    }
}

}  // namespace
}  // namespace voxray::test
