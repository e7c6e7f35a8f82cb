#include "scene/animation.h"
#include "scene/compose.h"
#include "scene/subdivide.h"
#include "scene_gltf_builder.h"

namespace voxray::test {
namespace {

/// The triangle of GltfBuilder, its second vertex carried by the second joint, its third by both, half and
/// half. The joints stand at x = 10 and x = 20; the mesh's own node is far away and scaled.
struct Skinned : GltfBuilder {
    int far, first, second;

    explicit Skinned(bool withMatrices = true) {
        const int joints =
            accessor(view(std::vector<uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, 4), 3, "VEC4", ubyteType);
        const int weights = floats(std::vector<glm::vec4>{{1, 0, 0, 0}, {2, 0, 0, 0}, {0.5f, 0.5f, 0, 0}}, "VEC4");
        far = triangle({{"attributes", {{"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}},
                       {{"skin", 0}, {"translation", {50, 0, 0}}, {"scale", {0.01, 0.01, 0.01}}});
        first = add("nodes", {{"translation", {10, 0, 0}}});
        second = add("nodes", {{"translation", {20, 0, 0}}});
        json skin = {{"joints", {first, second}}};
        if (withMatrices) {
            glm::mat4 up(1.0f);
            up[3] = glm::vec4(0, 1, 0, 1);
            skin["inverseBindMatrices"] = floats(std::vector<glm::mat4>{glm::mat4(1.0f), up}, "MAT4");
        }
        add("skins", skin);
    }
};

TEST(Skins, JointsPlaceVerticesAndTheNodeDoesNot) {
    const auto scene = Skinned().load();
    EXPECT_TRUE(scene->warnings.empty());
    const Geometry g = evaluate(scene, 0).geometry;
    // (0,0,0) by the first joint; (1,0,0) by the second, raised by 1; (0,1,0) by the mean of both.
    expectNear(g.positions[0], {10, 0, 0}, 1e-5f);
    expectNear(g.positions[1], {21, 1, 0}, 1e-5f);
    expectNear(g.positions[2], {15, 1.5f, 0}, 1e-5f);
    expectNear(evaluate(Skinned(false).load(), 0).geometry.positions[1], {21, 0, 0}, 1e-5f);
}

TEST(Skins, ScaledAndMirroredJointsTurnNormalsAndFronts) {
    Skinned b;
    for (const int joint : {b.first, b.second})
        b.root["nodes"][size_t(joint)] = {{"scale", {-2, 1, 1}}, {"translation", {10, 0, 0}}};
    const Geometry g = evaluate(b.load(), 0).geometry;
    const glm::uvec3 t = g.triangles[0];
    const glm::vec3 face = glm::cross(g.positions[t.y] - g.positions[t.x], g.positions[t.z] - g.positions[t.x]);
    for (const VertexAttributes& a : g.attributes) expectNear(a.normal, {0, 0, 1}, 1e-6f);
    EXPECT_GT(face.z, 0);
}

TEST(Skins, AnimatedJointsMoveVerticesWithinTheirBounds) {
    Skinned b;
    const int input = b.floats(std::vector<float>{0, 1}, "SCALAR");
    const int output = b.floats(std::vector<glm::vec3>{{20, 0, 0}, {20, 0, 8}}, "VEC3");
    b.add("animations", {{"samplers", {{{"input", input}, {"output", output}}}},
                         {"channels", {{{"sampler", 0}, {"target", {{"node", b.second}, {"path", "translation"}}}}}}});
    const auto scene = b.load();
    SceneState state = evaluate(scene, 0, Playback::Looping);
    ASSERT_TRUE(state.geometry.instances[0].moves);
    EXPECT_NEAR(state.geometry.boundsMax.z, 8, 1e-2);
    EXPECT_EQ(advance(state, 0.5).size(), 2u);
    expectNear(state.geometry.positions[0], {10, 0, 0}, 1e-5f);
    expectNear(state.geometry.positions[1], {21, 1, 4}, 1e-5f);
    expectNear(state.geometry.positions[2], {15, 1.5f, 2}, 1e-5f);
    EXPECT_FALSE(evaluate(Skinned().load(), 0, Playback::Looping).geometry.instances[0].moves);
}

TEST(Skins, PlacedScenesTakeTheirJointsAlong) {
    Placement placement;
    placement.translate = {0, 0, 5};
    placement.scale = glm::vec3(2);
    const auto placed = std::make_shared<Scene>(placedScene(*Skinned().load(), placement));
    expectNear(evaluate(placed, 0).geometry.positions[2], {30, 3, 5}, 1e-4f);
}

TEST(Skins, WhatCanNotBeSkinnedIsNamed) {
    Skinned outside;
    outside.root["scenes"] = {{{"nodes", {outside.far, outside.first}}}};
    const auto scene = outside.load();
    EXPECT_TRUE(warns(*scene, "joint node 2 is not in the scene"));
    expectNear(evaluate(scene, 0).geometry.positions[1], {50.01f, 0, 0}, 1e-5f);

    Skinned unweighted;
    unweighted.root["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
    EXPECT_TRUE(warns(*unweighted.load(), "no JOINTS_0 and WEIGHTS_0"));

    Skinned few;
    few.root["skins"][0]["joints"] = {few.first};
    EXPECT_CONTAINS(few.error(), "has joint 1, its skin has 1");
    few.root["skins"][0]["joints"] = json::array();
    EXPECT_CONTAINS(few.error(), "no joints");

    Scene skinned = *Skinned().load();
    EXPECT_ERROR("export-scene", subdivide(skinned, 1));
}

}  // namespace
}  // namespace voxray::test
