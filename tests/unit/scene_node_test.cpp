#include <cmath>

#include "scene_gltf_builder.h"

namespace voxray::test {
namespace {

constexpr float root = 0.70710678f;

TEST(GltfNodes, TransformsMultiplyDownTheHierarchy) {
    // Translate by x, turn 90 degrees about Z, scale: the point (1,0,0) goes to (5, 2 * 3, 0).
    GltfBuilder b;
    b.triangle({}, {{"scale", {2, 1, 1}}});
    b.add("nodes", {{"children", {0}}, {"rotation", {0, 0, root, root}}, {"scale", {3, 3, 3}}});
    b.add("nodes", {{"children", {1}}, {"translation", {5, 0, 0}}});
    const auto scene = b.load();
    for (size_t i = 0; i < scene->nodes.size(); ++i) EXPECT_LT(scene->nodes[i].parent, int(i));
    const Geometry g = evaluate(scene, 0).geometry;
    expectNear(g.positions[1], {5, 6, 0}, 1e-5f);
    expectNear(g.positions[2], {2, 0, 0}, 1e-5f);
}

TEST(GltfNodes, MatricesAreColumnMajor) {
    GltfBuilder b;
    b.triangle({}, {{"matrix", {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1}}});
    const Geometry g = evaluate(b.load(), 0).geometry;
    expectNear(g.positions[1], {7, 10, 9}, 0);
    expectNear(g.positions[2], {6, 8, 9}, 0);
}

TEST(GltfNodes, MirroringKeepsFrontsAndTangentFrames) {
    for (const bool mirrored : {false, true}) {
        GltfBuilder b;
        const int normals = b.floats(std::vector<glm::vec3>(3, {0, root, root}), "VEC3");
        const int tangents = b.floats(std::vector<glm::vec4>(3, {1, 0, 0, 1}), "VEC4");
        b.triangle({{"attributes", {{"NORMAL", normals}, {"TANGENT", tangents}}}},
                   {{"scale", {1, mirrored ? -1 : 1, 1}}});
        const Geometry g = evaluate(b.load(), 0).geometry;
        const glm::uvec3 t = g.triangles[0];
        const glm::vec3 face = glm::cross(g.positions[t.y] - g.positions[t.x], g.positions[t.z] - g.positions[t.x]);
        EXPECT_NEAR(face.z, 1, 1e-6);
        expectNear(g.attributes[0].normal, {0, mirrored ? -root : root, root}, 1e-6f);
        // The bitangent is mirrored with the mesh.
        const glm::vec4 tangent = g.attributes[0].tangent;
        const glm::vec3 bitangent = glm::cross(g.attributes[0].normal, glm::vec3(tangent)) * tangent.w;
        expectNear(bitangent, {0, mirrored ? -root : root, -root}, 1e-6f);
    }
}

TEST(GltfNodes, NormalsStayPerpendicularUnderUnevenScale) {
    GltfBuilder b;
    const int normals = b.floats(std::vector<glm::vec3>(3, {root, 0, root}), "VEC3");
    b.triangle({{"attributes", {{"NORMAL", normals}}}}, {{"scale", {4, 1, 1}}});
    const float length = std::sqrt(1.0f + 1.0f / 16);
    expectNear(evaluate(b.load(), 0).geometry.attributes[0].normal, {0.25f / length, 0, 1 / length}, 1e-6f);
    GltfBuilder flat;
    flat.triangle({}, {{"scale", {1, 1, 0}}});
    expectNear(evaluate(flat.load(), 0).geometry.attributes[0].normal, {0, 0, 1}, 0);
}

TEST(GltfNodes, OnlyTheDefaultSceneIsLoaded) {
    GltfBuilder b;
    for (int i = 0; i < 3; ++i) b.triangle({}, {{"translation", {i, 0, 0}}});
    EXPECT_EQ(b.load()->instances.size(), 3u);
    b.root["scenes"] = {{{"nodes", {1}}}, {{"nodes", {2, 0}}}};
    EXPECT_EQ(evaluate(b.load(), 0).geometry.boundsMin.x, 1);
    b.root["scene"] = 1;
    EXPECT_EQ(b.load()->instances.size(), 2u);
    b.root["scene"] = 7;
    EXPECT_CONTAINS(b.error(), "scene 7");
}

TEST(GltfNodes, CyclesAndSecondParentsAreRefused) {
    GltfBuilder b;
    b.triangle({}, {{"children", {1}}});
    b.add("nodes", {{"children", {0}}});
    b.root["scenes"] = {{{"nodes", {0}}}};
    EXPECT_CONTAINS(b.error(), "two parents");
    b.root.erase("scenes");
    EXPECT_CONTAINS(b.error(), "no triangles");
    b.root["nodes"][1]["children"] = {5};
    EXPECT_CONTAINS(b.error(), "node 5");
    b.root["nodes"] = {{{"mesh", 0}}, {{"children", {0}}}, {{"children", {0}}}};
    EXPECT_CONTAINS(b.error(), "two parents");
    b.root["nodes"] = {{{"mesh", 0}, {"rotation", {0, 0, 0, 0}}}};
    EXPECT_CONTAINS(b.error(), "rotation");
    b.root["nodes"] = {{{"mesh", 0}, {"scale", {1e39, 1, 1}}}};
    EXPECT_CONTAINS(b.error(), "scale");
}

TEST(GltfNodes, DeepHierarchiesAreWalkedWithoutRecursion) {
    GltfBuilder b;
    b.triangle();
    for (int i = 0; i < 20000; ++i) b.add("nodes", {{"children", {i}}, {"translation", {0, 0, 0.5}}});
    EXPECT_FLOAT_EQ(evaluate(b.load(), 0).geometry.boundsMin.z, 10000);
}

TEST(GltfNodes, LightsAndCamerasAreUsedAsTheirNodesPlaceThem) {
    GltfBuilder b;
    b.triangle();
    b.root["extensionsUsed"] = {"KHR_lights_punctual"};
    b.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"color", {1, 0.5, 0.25}},
         {"intensity", 8},
         {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}}},
        {{"type", "point"}, {"name", "bulb"}},
        {{"type", "directional"}, {"intensity", 3}}};
    b.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 10}, {"znear", 0.1}}}}};
    const json turn = {0, root, 0, root};  // 90 degrees about Y: -Z becomes -X.
    const auto light = [](int index) { return json{{"KHR_lights_punctual", {{"light", index}}}}; };
    b.add("nodes", {{"extensions", light(0)}, {"rotation", turn}, {"translation", {1, 2, 3}}, {"scale", {5, 5, 5}}});
    b.add("nodes", {{"extensions", light(1)}});
    b.add("nodes", {{"extensions", light(2)}, {"rotation", {-root, 0, 0, root}}});
    b.add("nodes", {{"camera", 0}, {"rotation", turn}, {"translation", {4, 5, 6}}, {"name", "view"}});
    b.add("nodes", {{"camera", 1}});
    const auto scene = b.load();
    const SceneState state = evaluate(scene, 0);
    ASSERT_EQ(state.lights.size(), 3u);
    EXPECT_EQ(state.lights[0].type, LightType::Spot);
    expectNear(state.lights[0].intensity, {8, 4, 2}, 1e-6f);
    expectNear(state.lights[0].position, {1, 2, 3}, 0);
    expectNear(state.lights[0].direction, {-1, 0, 0}, 1e-6f);
    EXPECT_FLOAT_EQ(state.lights[0].outerConeAngle, 0.4f);
    EXPECT_EQ(state.lights[1].intensity, glm::vec3(1));
    EXPECT_EQ(state.lights[1].name, "bulb");
    expectNear(state.lights[2].direction, {0, -1, 0}, 1e-6f);
    ASSERT_EQ(state.cameras.size(), 1u);
    EXPECT_EQ(state.cameras[0].name, "view");
    expectNear(state.cameras[0].forward, {-1, 0, 0}, 1e-6f);
    expectNear(state.cameras[0].position, {4, 5, 6}, 0);
    EXPECT_FLOAT_EQ(state.cameras[0].verticalFovRadians, 0.7f);
    EXPECT_EQ(state.cameras[0].node, -1);
    EXPECT_TRUE(warns(*scene, "orthographic"));

    b.root["nodes"][1]["scale"] = {0, 0, 0};
    EXPECT_THROW(evaluate(b.load(), 0), Error);
    b.root["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = -1;
    b.root["nodes"][1].erase("scale");
    b.root["extensions"]["KHR_lights_punctual"]["lights"][0]["spot"]["outerConeAngle"] = 2;
    const auto limited = b.load();
    EXPECT_TRUE(warns(*limited, "light 'light 0': intensity is -1, not from 0"));
    EXPECT_EQ(limited->lights[0].intensity, glm::vec3(0));
    EXPECT_TRUE(warns(*limited, "outerConeAngle is 2"));
    EXPECT_FLOAT_EQ(limited->lights[0].outerConeAngle, 1.5708f);
}

}  // namespace
}  // namespace voxray::test
