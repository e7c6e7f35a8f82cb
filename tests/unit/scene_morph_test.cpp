// Morph targets: positions, normals and tangents at given times by hand, and files that are refused.
#include <cmath>
#include <glm/geometric.hpp>

#include "morphing_gltf.h"
#include "scene/compose.h"
#include "scene/subdivide.h"
#include "tests/support/places.h"

namespace voxray::test {
namespace {

TEST(Morphs, DefaultWeightsAreAppliedAndANodesOwnComeFirst) {
    Morphing b;
    b.root["meshes"][0]["weights"] = {0.25, 0.5};
    b.add("nodes", {{"mesh", 0}, {"weights", {0, 1}}});
    const auto scene = b.load();
    const Geometry g = evaluate(scene, 0).geometry;
    ASSERT_EQ(g.positions.size(), 6u);
    expectNear(g.positions[1], {1, 1, 1}, 1e-6f);
    expectNear(g.positions[3 + 1], {1, 0, 2}, 1e-6f);
    for (const Mesh& mesh : scene->meshes) EXPECT_TRUE(mesh.morph.targets.empty());
    EXPECT_FALSE(evaluate(scene, 0, Playback::Looping).geometry.instances[0].moves);
}

TEST(Morphs, WeightsFollowTheirKeys) {
    const auto linear = Morphing().animate({1, 3}, {0, 0, 1, 0.5f}).load();
    EXPECT_TRUE(linear->warnings.empty());
    expectNear(vertexAt(linear, 0, 1), {1, 0, 0}, 0);
    expectNear(vertexAt(linear, 1.5, 1), {1, 1, 0.25f}, 1e-6f);
    expectNear(vertexAt(linear, 9, 1), {1, 4, 1}, 0);
    expectNear(vertexAt(linear, 9, 0), {0, 0, 1}, 0);

    const auto step = Morphing().animate({1, 3}, {0, 0, 1, 0.5f}, "STEP").load();
    expectNear(vertexAt(step, 2.99, 1), {1, 0, 0}, 0);
    expectNear(vertexAt(step, 3, 1), {1, 4, 1}, 0);

    // In-tangents, weights and out-tangents of both targets; the first weight is t^3 on [0, 2], the second t / 2.
    const std::vector<float> keys{0, 0, 0, 0, 0, 0.5f, 12, 0.5f, 8, 1, 0, 0};
    const auto cubic = Morphing().animate({0, 2}, keys, "CUBICSPLINE").load();
    for (const float t : {0.0f, 0.5f, 1.3f, 2.0f}) expectNear(vertexAt(cubic, t, 1), {1, 4 * t * t * t, t}, 2e-5f);
}

TEST(Morphs, AnimatedWeightsComeBeforeThoseOfNodeAndMesh) {
    Morphing b(json::object({{"weights", {1, 1}}, {"translation", {0, 0, 10}}}));
    b.root["meshes"][0]["weights"] = {1, 1};
    b.add("nodes", {{"mesh", 0}});
    const auto scene = b.animate({0, 1}, {0, 0, 0.5f, 0}).load();
    const Geometry g = evaluate(scene, 1).geometry;
    expectNear(g.positions[1], {1, 2, 10}, 1e-6f);
    expectNear(g.positions[3 + 1], {1, 4, 2}, 1e-6f);  // The other node's weights are the mesh's
    const Geometry looping = evaluate(scene, 0, Playback::Looping).geometry;
    EXPECT_TRUE(looping.instances[0].moves);
    EXPECT_FALSE(looping.instances[1].moves);
}

TEST(Morphs, KhronosSampleMovesByItsDocumentedWeights) {
    const std::filesystem::path file = scenesFolder() / "gltf-samples/SimpleMorph/SimpleMorph.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no test scenes";
    // Keys at 0 to 4 s: (0, 0) (0, 1) (1, 1) (1, 0) (0, 0); the targets move the third vertex by (-1, 1), (1, 1)
    const auto scene = loadGltf(file);
    EXPECT_TRUE(scene->warnings.empty());
    const glm::vec3 rest = vertexAt(scene, 0, 2);
    expectNear(vertexAt(scene, 1, 2) - rest, {1, 1, 0}, 1e-6f);
    expectNear(vertexAt(scene, 2, 2) - rest, {0, 2, 0}, 1e-6f);
    expectNear(vertexAt(scene, 2.5, 2) - rest, {-0.5f, 1.5f, 0}, 1e-6f);
    expectNear(vertexAt(scene, 3, 2) - rest, {-1, 1, 0}, 1e-6f);
}

TEST(Morphs, SparseAndNormalizedAccessorsAreRead) {
    // Targets: 127 of 127 is 1; a sparse one without a buffer moves the third vertex alone. Weights: 51 of 255.
    Morphing b;
    const int bytes = b.accessor(b.view(std::vector<int8_t>{0, 0, 0, 0, 127, -127, 0, 0, 0, 0, 0, 0}, 4), 3, "VEC3",
                                 byteType, {{"normalized", true}});
    b.root["accessors"].push_back(
        {{"count", 3},
         {"type", "VEC3"},
         {"componentType", floatType},
         {"sparse",
          {{"count", 1},
           {"indices", {{"bufferView", b.view(std::vector<uint16_t>{2})}, {"componentType", ushortType}}},
           {"values", {{"bufferView", b.view(std::vector<glm::vec3>{{7, 0, 0}})}}}}}});
    b.primitiveJson()["targets"] = {{{"POSITION", bytes}}, {{"POSITION", b.root["accessors"].size() - 1}}};
    b.animateBy({0, 1}, b.accessor(b.view(std::vector<uint8_t>{0, 0, 255, 51}), 4, "SCALAR", ubyteType,
                                   {{"normalized", true}}));
    const auto scene = b.load();
    expectNear(vertexAt(scene, 1, 1), {2, -1, 0}, 1e-6f);
    expectNear(vertexAt(scene, 1, 2), {7 * 0.2f, 1, 0}, 1e-6f);
    expectNear(vertexAt(scene, 0.5, 1), {1.5f, -0.5f, 0}, 1e-6f);
}

TEST(Morphs, NormalsAndTangentsOfTheFileAreMoved) {
    Morphing b;
    const int normals = b.floats(std::vector<glm::vec3>(3, {0, 0, 1}), "VEC3");
    const int tangents = b.floats(std::vector<glm::vec4>(3, {1, 0, 0, -1}), "VEC4");
    const int tilt = b.floats(std::vector<glm::vec3>(3, {0, 1, 0}), "VEC3");
    const int flip = b.floats(std::vector<glm::vec3>(3, {0, 0, -2}), "VEC3");
    const int turn = b.floats(std::vector<glm::vec3>(3, {-1, 1, 0}), "VEC3");
    b.primitiveJson()["attributes"].update({{"NORMAL", normals}, {"TANGENT", tangents}});
    b.primitiveJson()["targets"] = {{{"NORMAL", tilt}, {"TANGENT", turn}}, {{"NORMAL", flip}}};
    const auto scene = b.animate({0, 1, 2}, {0, 0, 1, 0, 0, 0.5f}).load();
    const auto attributes = [&](double time) { return evaluate(scene, time).geometry.attributes[1]; };
    expectNear(attributes(0).normal, {0, 0, 1}, 0);
    expectNear(attributes(1).normal, glm::vec3(0, 1, 1) / std::sqrt(2.0f), 1e-6f);
    expectNear(attributes(0.5).tangent, glm::vec3(1, 1, 0) / std::sqrt(2.0f), 1e-6f);
    expectNear(attributes(1).tangent, {0, 1, 0}, 1e-6f);
    EXPECT_EQ(attributes(1).tangent.w, -1);
    expectNear(attributes(2).normal, {0, 0, 1}, 0);  // Their sum is zero: they stay
}

TEST(Morphs, NormalsAndTangentsThatTheFileLacksFollowPositions) {
    // The second vertex goes to (0,0,1), and so the front from +Z to -X.
    Morphing b;
    b.add("images", {{"bufferView", b.view(tinyPng())}, {"mimeType", "image/png"}});
    b.add("textures", {{"source", 0}});
    b.add("materials", {{"normalTexture", {{"index", 0}}}});
    const int turn = b.floats(std::vector<glm::vec3>{{0, 0, 0}, {-1, 0, 1}, {0, 0, 0}}, "VEC3");
    b.primitiveJson()["targets"] = {{{"POSITION", turn}}};
    b.primitiveJson()["attributes"]["TEXCOORD_0"] = b.floats(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}, "VEC2");
    b.primitiveJson()["material"] = 0;
    Morphing fixed = b;
    fixed.root["meshes"][0]["weights"] = {1};
    const auto moving = b.animate({0, 1}, {0, 1}).load(), still = fixed.load();
    expectNear(evaluate(moving, 0).geometry.attributes[0].normal, {0, 0, 1}, 0);
    expectNear(evaluate(moving, 0).geometry.attributes[0].tangent, {1, 0, 0}, 0);
    for (const Geometry& g : {evaluate(moving, 1).geometry, evaluate(still, 0).geometry})
        for (const VertexAttributes& a : g.attributes) {
            expectNear(a.normal, {-1, 0, 0}, 1e-6f);
            expectNear(a.tangent, {0, 0, 1}, 1e-6f);
        }
}

TEST(Morphs, SkinsCarryTheMorphedMesh) {
    Morphing b(json::object({{"skin", 0}, {"translation", {50, 0, 0}}}));
    const int joints = b.accessor(b.view(std::vector<uint8_t>(12, 0), 4), 3, "VEC4", ubyteType);
    const int weights = b.floats(std::vector<glm::vec4>(3, {1, 0, 0, 0}), "VEC4");
    b.primitiveJson()["attributes"].update({{"JOINTS_0", joints}, {"WEIGHTS_0", weights}});
    // A turn by 90 degrees about +Z, then 10 along +X: (x, y, z) to (10 - y, x, z)
    const float half = std::sqrt(0.5f);
    const int joint = b.add("nodes", {{"translation", {10, 0, 0}}, {"rotation", {0, 0, half, half}}});
    b.add("skins", {{"joints", {joint}}});
    const auto scene = b.animate({0, 1}, {0, 0, 1, 0.5f}).load();
    expectNear(vertexAt(scene, 0, 1), {10, 1, 0}, 1e-5f);
    expectNear(vertexAt(scene, 1, 1), {6, 1, 1}, 1e-5f);
    expectNear(vertexAt(scene, 0.5, 2), {9, 0, 0.5f}, 1e-5f);
}

TEST(Morphs, ComposedAndSubdividedScenesKeepThem) {
    const auto scene = Morphing().animate({0, 1}, {0, 0, 1, 0.5f}).load();
    Placement placement;
    placement.translate = {0, 0, 5};
    placement.scale = glm::vec3(2);
    Scene both = placedScene(*scene, placement);
    addScene(both, *Morphing().animate({0, 2}, {1, 0, 0, 0}).load(), {}, "added");
    const auto composed = std::make_shared<Scene>(both);
    expectNear(vertexAt(composed, 1, 1), {2, 8, 7}, 1e-5f);
    expectNear(vertexAt(composed, 1, 3 + 1), {1, 2, 0}, 1e-5f);

    subdivide(both, 1);
    const Geometry g = evaluate(std::make_shared<Scene>(both), 1).geometry;
    ASSERT_EQ(g.triangles.size(), 8u);
    double area = 0;
    for (uint32_t t = 0; t < 4; ++t) area += triangleArea(g, t);
    const Geometry whole = evaluate(composed, 1).geometry;
    EXPECT_NEAR(area, triangleArea(whole, 0), 1e-5);
}

TEST(Morphs, WhatDoesNotFitIsRefusedWithWhatToDo) {
    Morphing few;
    few.root["meshes"][0]["weights"] = {1};
    EXPECT_CONTAINS(few.error(), "mesh 0 '': 1 weights for 2 morph targets; give one for each");
    few.root["meshes"][0].erase("weights");
    few.root["nodes"][0]["weights"] = {1, 0, 0};
    EXPECT_CONTAINS(few.error(), "node 0 '': 3 weights for 2 morph targets");

    EXPECT_CONTAINS(Morphing().animate({0, 1}, {0, 1, 2}).error(),
                    "3 values for 2 keys of 2 weights, one for each morph target; export the animation anew");
    EXPECT_CONTAINS(Morphing().animate({0, 1}, {0, 1, 2, 3}, "CUBICSPLINE").error(),
                    "4 values for 6 keys of 2 weights");
    EXPECT_CONTAINS(Morphing().animate({0, 1}, {0, 1, 2, NAN}).error(), "value 3 is not finite");

    Morphing shorter;
    shorter.root["accessors"][size_t(shorter.out)]["count"] = 2;
    shorter.animate({0, 1}, {0, 0, 1, 1});
    EXPECT_CONTAINS(shorter.error(),
                    "morph target 1: its POSITION has 2 elements for 3 positions; export the mesh anew");

    Morphing uneven;
    uneven.root["meshes"][0]["primitives"].push_back(uneven.primitiveJson());
    uneven.root["meshes"][0]["primitives"][1]["targets"].erase(0);
    EXPECT_CONTAINS(uneven.error(), "its primitives have 2 and 1 morph targets; give each as many");

    Morphing infinite;
    infinite.primitiveJson()["targets"][1]["POSITION"] =
        infinite.floats(std::vector<glm::vec3>(3, {0, INFINITY, 0}), "VEC3");
    infinite.root["meshes"][0]["weights"] = {0, 1};
    EXPECT_CONTAINS(infinite.error(), "morph target 1: POSITION 0 is not finite");
}

TEST(Morphs, WhatIsLeftOutIsNamed) {
    Morphing colored;
    colored.primitiveJson()["targets"][0]["COLOR_0"] = colored.out;
    EXPECT_TRUE(warns(*colored.animate({0, 1}, {0, 0, 1, 0}).load(), "morph target 0: COLOR_0 is left out"));

    Morphing none;
    none.primitiveJson().erase("targets");
    EXPECT_TRUE(warns(*none.animate({0, 1}, {0, 1}).load(), "weights of node 0 are left out"));
    Morphing twice;
    twice.animate({0, 1}, {0, 0, 1, 0}).animate({0, 1}, {0, 0, 0, 1});
    const auto scene = twice.load();
    EXPECT_TRUE(warns(*scene, "weights of node 0 are animated twice"));
    expectNear(vertexAt(scene, 1, 1), {1, 4, 0}, 1e-6f);
}

}  // namespace
}  // namespace voxray::test
