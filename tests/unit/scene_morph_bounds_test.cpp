// Bounds of a scene over all times of morph targets, and states that are moved to another time.
#include <cstring>
#include <glm/common.hpp>

#include "morphing_gltf.h"
#include "scene/morph.h"

namespace voxray::test {
namespace {

template <typename T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// A mesh on a node that travels, turned by a joint or not, whose spline of weights goes beyond its keys.
std::shared_ptr<const Scene> travelling(bool isSkinned) {
    Morphing b(isSkinned ? json::object({{"skin", 0}}) : json::object());
    int node = 0;
    if (isSkinned) {
        const int joints = b.accessor(b.view(std::vector<uint8_t>(12, 0), 4), 3, "VEC4", ubyteType);
        const int weights = b.floats(std::vector<glm::vec4>(3, {1, 0, 0, 0}), "VEC4");
        b.primitiveJson()["attributes"].update({{"JOINTS_0", joints}, {"WEIGHTS_0", weights}});
        node = b.add("nodes", {{"scale", {1, 2, 1}}});
        b.add("skins", {{"joints", {node}}});
    }
    b.add("animations", {{"samplers",
                          {{{"input", b.floats(std::vector<float>{0, 3}, "SCALAR")},
                            {"output", b.floats(std::vector<glm::vec3>{{0, 0, 0}, {5, 0, 0}}, "VEC3")}}}},
                         {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}}}});
    return b.animate({0, 1, 3}, {0, 0, 0, 0, 3, 0, 1, 0, 1, 1, 0, -2, 0, 0, 0, 1, 0, 0}, "CUBICSPLINE").load();
}

TEST(MorphBounds, HoldTheWholeMotion) {
    for (const bool isSkinned : {false, true}) {
        const auto scene = travelling(isSkinned);
        const Geometry looping = evaluate(scene, 0, Playback::Looping).geometry;
        Box all = Box::empty();
        for (int i = 0; i < 300; ++i) {
            const Geometry g = evaluate(scene, 0.01 * i).geometry;
            all.include({g.boundsMin, g.boundsMax});
        }
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(looping.boundsMin[axis], all.min[axis]) << isSkinned;
            EXPECT_GE(looping.boundsMax[axis], all.max[axis]) << isSkinned;
        }
        EXPECT_LT(looping.boundsMax.y, 1.5f * all.max.y) << "bounds say nothing";
    }
    // Between linear keys nothing lies outside of them: bounds are tight.
    const auto linear = Morphing().animate({0, 1, 2}, {0, 0, 1, 0.5f, 0, 1}).load();
    const Geometry g = evaluate(linear, 0, Playback::Looping).geometry;
    expectNear(g.boundsMin, {0, 0, 0}, 1e-3f);
    expectNear(g.boundsMax, {1, 4, 2}, 1e-3f);
}

TEST(MorphBounds, AdvancedStateEqualsOneEvaluatedThere) {
    for (const bool isSkinned : {false, true}) {
        const auto scene = travelling(isSkinned);
        SceneState state = evaluate(scene, 0.4, Playback::Looping);
        ASSERT_TRUE(state.geometry.instances[0].moves);
        for (const double time : {0.9, 2.9, 7.0, -0.1}) {
            EXPECT_EQ(advance(state, time).size(), 2u);
            const Geometry there = evaluate(scene, time, Playback::Looping).geometry;
            EXPECT_TRUE(sameBytes(state.geometry.positions, there.positions)) << time;
            EXPECT_TRUE(sameBytes(state.geometry.attributes, there.attributes)) << time;
        }
    }
}

TEST(MorphBounds, WeightsThatStayMoveNothing) {
    const auto still = Morphing().animate({0, 1}, {0.5f, 0, 0.5f, 0}).load();
    EXPECT_FALSE(changes(still->morphs.at(0)));
    SceneState state = evaluate(still, 0, Playback::Looping);
    EXPECT_FALSE(state.geometry.instances[0].moves);
    EXPECT_TRUE(advance(state, 0.5).empty());
    expectNear(state.geometry.positions[1], {1, 2, 0}, 1e-6f);
}

}  // namespace
}  // namespace voxray::test
