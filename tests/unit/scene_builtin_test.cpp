#include <gtest/gtest.h>

#include <cmath>

#include "scene/load.h"

namespace voxray {
namespace {

Value parameter(const std::string& key, const std::string& text) {
    Value map = Value::map();
    map.set(key, Value::fromScalar(text));
    return map;
}

SceneState build(const std::string& name, const Value& params = {}) {
    return evaluate(makeBuiltinScene(name, params), 0);
}

glm::vec3 faceNormal(const Geometry& g, size_t triangle) {
    const glm::uvec3 t = g.triangles[triangle];
    return glm::normalize(
        glm::cross(g.positions[t.y] - g.positions[t.x], g.positions[t.z] - g.positions[t.x]));
}

glm::vec3 centroid(const Geometry& g, size_t triangle) {
    const glm::uvec3 t = g.triangles[triangle];
    return (g.positions[t.x] + g.positions[t.y] + g.positions[t.z]) / 3.0f;
}

/// Solid angle of a triangle seen from a point, negative from behind (Van Oosterom and Strackee 1983).
double solidAngle(const Geometry& g, size_t triangle, const glm::dvec3& from) {
    const glm::uvec3 t = g.triangles[triangle];
    const glm::dvec3 a = glm::dvec3(g.positions[t.x]) - from;
    const glm::dvec3 b = glm::dvec3(g.positions[t.y]) - from;
    const glm::dvec3 c = glm::dvec3(g.positions[t.z]) - from;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return -2 * std::atan2(glm::dot(a, glm::cross(b, c)), denominator);
}

TEST(BuiltinScenes, EveryOneHasACameraTrianglesAndSoundNormals) {
    for (const std::string& name : builtinSceneNames()) {
        SCOPED_TRACE(name);
        const SceneState state = build(name);
        const Geometry& g = state.geometry;
        ASSERT_FALSE(state.cameras.empty());
        ASSERT_FALSE(g.triangles.empty());
        EXPECT_EQ(state.scene->contentHash.size(), 32u);
        EXPECT_FALSE(describeBuiltinScene(name).empty());
        for (size_t i = 0; i < g.triangles.size(); ++i)
            for (int corner = 0; corner < 3; ++corner)
                ASSERT_GT(glm::dot(g.attributes[g.triangles[i][corner]].normal, faceNormal(g, i)), 0.9f) << i;
        const Camera& camera = state.cameras[0];
        EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0, 1e-6);
        EXPECT_NEAR(glm::length(camera.forward), 1, 1e-6);
    }
}

TEST(BuiltinScenes, ClosedOnesFillTheCamerasWholeSphereWithTheirFronts) {
    for (const char* name : {"furnace", "white_room", "thin_wall"}) {
        SCOPED_TRACE(name);
        const SceneState state = build(name);
        double sum = 0;
        for (size_t i = 0; i < state.geometry.triangles.size(); ++i)
            sum += solidAngle(state.geometry, i, glm::dvec3(state.cameras[0].position));
        EXPECT_NEAR(sum, 4 * M_PI, 1e-4);
    }
    const SceneState box = build("furnace", parameter("shape", "box"));
    EXPECT_EQ(box.geometry.triangles.size(), 12u);
    double sum = 0;
    for (size_t i = 0; i < 12; ++i) sum += solidAngle(box.geometry, i, {0.3, -0.2, 0.1});
    EXPECT_NEAR(sum, 4 * M_PI, 1e-5);
}

TEST(BuiltinScenes, CornellIsTheClassicBox) {
    const SceneState state = build("cornell");
    const Geometry& g = state.geometry;
    EXPECT_EQ(g.triangles.size(), 2u * (5 + 6 + 6 + 1));
    EXPECT_EQ(g.boundsMin, glm::vec3(-1, 0, -1));
    EXPECT_EQ(g.boundsMax, glm::vec3(1, 2, 1));
    size_t lamps = 0;
    for (size_t i = 0; i < g.triangles.size(); ++i) {
        const Material& m = state.scene->materials[g.triangleMaterials[i]];
        EXPECT_EQ(m.metallic, 0);
        EXPECT_EQ(m.specular, 0);
        if (m.emission.x > 0) {
            ++lamps;
            EXPECT_NEAR(faceNormal(g, i).y, -1, 1e-6);
        }
        if (m.name == "red") {
            EXPECT_NEAR(centroid(g, i).x, -1, 1e-6);
        }
        if (m.name == "green") {
            EXPECT_NEAR(centroid(g, i).x, 1, 1e-6);
        }
    }
    EXPECT_EQ(lamps, 2u);
    EXPECT_TRUE(state.lights.empty());
    EXPECT_EQ(build("cornell", parameter("lights", "spot")).lights.at(0).type, LightType::Spot);
    EXPECT_EQ(build("cornell", parameter("lights", "sun")).lights.at(0).type, LightType::Directional);
    EXPECT_EQ(build("cornell", parameter("boxes", "false")).geometry.triangles.size(), 12u);
}

TEST(BuiltinScenes, FurnaceAndThinWallTakeTheirParameters) {
    const SceneState furnace = build("furnace", parameter("albedo", "0.25"));
    EXPECT_EQ(furnace.scene->materials[0].baseColor, glm::vec4(0.25f, 0.25f, 0.25f, 1));
    EXPECT_EQ(furnace.scene->materials[0].emission, glm::vec3(1));
    const SceneState wall = build("thin_wall", parameter("thickness", "0.2"));
    EXPECT_FLOAT_EQ(wall.geometry.boundsMax.x, 2.1f);
    EXPECT_GT(wall.cameras[0].position.x, 0.1f);
    EXPECT_LT(wall.lights[0].position.x, -0.1f);
    EXPECT_LT(build("thin_wall", parameter("view", "lit")).cameras[0].position.x, -0.1f);
}

TEST(BuiltinScenes, SpheresMoveOnClosedPathsAndSeedsDiffer) {
    const auto scene = makeBuiltinScene("spheres", parameter("count", "3"));
    const Geometry start = evaluate(scene, 0).geometry;
    const Geometry half = evaluate(scene, 4).geometry;
    const Geometry end = evaluate(scene, 8).geometry;
    EXPECT_EQ(start.positions, end.positions);
    EXPECT_GT(glm::length(half.positions.back() - start.positions.back()), 0.5f);
    EXPECT_EQ(start.instances.size(), 4u);
    const auto again = makeBuiltinScene("spheres", parameter("count", "3"));
    EXPECT_EQ(scene->contentHash, again->contentHash);
    Value other = parameter("count", "3");
    other.set("seed", Value::fromScalar("2"));
    EXPECT_NE(scene->contentHash, makeBuiltinScene("spheres", other)->contentHash);
    EXPECT_EQ(evaluate(makeBuiltinScene("spheres", parameter("moving", "false")), 4).geometry.positions,
              evaluate(makeBuiltinScene("spheres", parameter("moving", "false")), 0).geometry.positions);
}

TEST(BuiltinScenes, BadNamesAndParametersAreUsageErrors) {
    EXPECT_THROW(makeBuiltinScene("cornel", {}), UsageError);
    EXPECT_THROW(makeBuiltinScene("cornell", parameter("light", "area")), UsageError);
    EXPECT_THROW(makeBuiltinScene("cornell", parameter("lights", "moon")), UsageError);
    EXPECT_THROW(makeBuiltinScene("furnace", parameter("albedo", "1.5")), UsageError);
    EXPECT_THROW(describeBuiltinScene("nothing"), UsageError);
}

TEST(BuiltinScenes, LambertMaterialsKeepColourAndEmission) {
    const auto mirror = makeBuiltinScene("mirror_room", {});
    const auto lambert = withLambertMaterials(*mirror);
    EXPECT_NE(mirror->contentHash, lambert->contentHash);
    for (size_t i = 0; i < lambert->materials.size(); ++i) {
        EXPECT_EQ(lambert->materials[i].metallic, 0);
        EXPECT_EQ(lambert->materials[i].specular, 0);
        EXPECT_EQ(lambert->materials[i].baseColor, mirror->materials[i].baseColor);
        EXPECT_EQ(lambert->materials[i].emission, mirror->materials[i].emission);
    }
}

}  // namespace
}  // namespace voxray
