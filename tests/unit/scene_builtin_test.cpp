#include <gtest/gtest.h>

#include <algorithm>
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
    return glm::normalize(glm::cross(g.positions[t.y] - g.positions[t.x], g.positions[t.z] - g.positions[t.x]));
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

TEST(BuiltinScenes, BoughsOfTheTreeSwayAndItsLeavesAreMasks) {
    const auto scene = makeBuiltinScene("tree", parameter("sway", "0.2"));
    const Geometry start = evaluate(scene, 0).geometry, later = evaluate(scene, 1).geometry;
    ASSERT_EQ(start.positions.size(), later.positions.size());
    float most = 0;
    size_t moved = 0;
    for (size_t i = 0; i < start.positions.size(); ++i) {
        const float way = glm::length(later.positions[i] - start.positions[i]);
        most = std::max(most, way);
        moved += way > 0;
    }
    EXPECT_EQ(moved, 4 * 900u);                   // all corners of leaves, and neither the trunk's nor the floor's
    EXPECT_LT(most, 2 * 0.2f * std::sqrt(2.1f));  // the whole sway, of a bough that sways furthest
    EXPECT_EQ(start.positions, evaluate(scene, 3).geometry.positions);
    EXPECT_EQ(evaluate(makeBuiltinScene("tree", parameter("sway", "0")), 1).geometry.positions.size(),
              start.positions.size());
    const Material& leaf = scene->materials[scene->meshes.back().material];
    EXPECT_EQ(leaf.alphaMode, AlphaMode::Mask);
    // A leaf of |y| < 0.8 sin(pi x) covers 0.8 * 2 / pi = 0.51 of its square
    const Texture& texture = scene->textures[size_t(leaf.baseColorTexture.texture)];
    size_t covered = 0;
    for (size_t i = 3; i < texture.rgba.size(); i += 4) covered += texture.rgba[i] != 0;
    EXPECT_NEAR(double(covered) / (texture.width * texture.height), 0.51, 0.02);
}

TEST(BuiltinScenes, TheFigureBendsAboveItsMiddle) {
    const auto scene = makeBuiltinScene("figure", parameter("bend_deg", "60"));
    const Geometry start = evaluate(scene, 0).geometry, bent = evaluate(scene, 0.5).geometry;
    const size_t top = start.positions.size() - 1;  // the middle of its upper end, 0.85 m above the joint
    EXPECT_NEAR(start.positions[top].y, 1.7f, 1e-4f);
    EXPECT_NEAR(bent.positions[top].x, -0.85f * std::sin(M_PI / 3), 1e-3);
    EXPECT_NEAR(bent.positions[top].y, 0.85f + 0.85f * std::cos(M_PI / 3), 1e-3);
    for (size_t i = 0; i < top; ++i)
        if (start.positions[i].y < 0.35f * 1.7f) {
            EXPECT_LT(glm::length(bent.positions[i] - start.positions[i]), 1e-5f) << i;
        }
}

TEST(BuiltinScenes, WallsAreClosedSolids) {
    // A point inside a solid sees its fronts from behind all round it; one outside of it sees as much of them
    // from before as from behind. A room that is sealed lies outside of its walls' solid.
    const auto sumFrom = [](const SceneState& state, const glm::dvec3& point) {
        double sum = 0;
        for (size_t i = 0; i < state.geometry.triangles.size(); ++i) sum += solidAngle(state.geometry, i, point);
        return sum;
    };
    Value window = parameter("sill", "0.2");
    window.set("wall_thickness", Value::fromScalar("0.3"));
    window.set("ground_distance", Value::fromScalar("3"));
    for (const SceneState& state : {build("window_room"), build("window_room", window), build("shell_room")}) {
        SCOPED_TRACE(state.scene->name);
        EXPECT_NEAR(sumFrom(state, glm::dvec3(state.cameras[0].position)), 0, 1e-4);
        EXPECT_NEAR(sumFrom(state, {0.1, 1.2, 20}), 0, 1e-4);
        EXPECT_NEAR(sumFrom(state, {0.1, 1.2, -2.05}), -4 * M_PI, 1e-4) << "inside the wall";
    }
    // The walls of clutter are sheets that look inwards.
    EXPECT_NEAR(sumFrom(build("clutter"), {-2.9, 2.7, -2.4}), 4 * M_PI, 1e-4);
}

TEST(BuiltinScenes, WindowRoomHasItsBlindAndItsSun) {
    Value params = parameter("slats", "26");
    params.set("slat_tilt_deg", Value::fromScalar("90"));
    params.set("slat_width", Value::fromScalar("0.05"));
    const SceneState open = build("window_room");
    const SceneState closed = build("window_room", params);
    EXPECT_EQ(closed.geometry.triangles.size(), open.geometry.triangles.size() + 2 * 26);
    // 26 upright slats of 5 cm fill 1.3 m of window, 1.98 m wide.
    double area = 0;
    for (const glm::uvec3& t : closed.geometry.triangles) {
        const auto& p = closed.geometry.positions;
        const bool isInTheWall = p[t.x].z > 2.09f && p[t.x].z < 2.11f;
        if (isInTheWall) area += 0.5 * double(glm::length(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x])));
    }
    EXPECT_NEAR(area, 1.98 * 1.3, 1e-4);
    const SceneState low = build("window_room", parameter("sun_elevation_deg", "10"));
    EXPECT_NEAR(low.lights.at(0).direction.y, -std::sin(10 * M_PI / 180), 1e-6);
    EXPECT_LT(low.lights.at(0).direction.z, 0);
    EXPECT_EQ(build("window_room", parameter("ground_distance", "5")).geometry.boundsMin.y, -5.5f);
}

TEST(BuiltinScenes, ClutterFollowsItsSeedAndStaysInItsRoom) {
    const auto clutter = [](const char* seed) { return makeBuiltinScene("clutter", parameter("seed", seed)); };
    EXPECT_EQ(clutter("1")->contentHash, clutter("1")->contentHash);
    EXPECT_NE(clutter("1")->contentHash, clutter("2")->contentHash);
    EXPECT_EQ(build("clutter", parameter("count", "0")).geometry.triangles.size(), 12u);
    for (const char* seed : {"1", "2", "3"}) {
        Value full = parameter("seed", seed);
        full.set("count", Value::fromScalar("30"));
        const Geometry g = build("clutter", full).geometry;
        EXPECT_EQ(g.boundsMin, glm::vec3(-3, 0, -2.5f));
        EXPECT_EQ(g.boundsMax, glm::vec3(3, 2.8f, 2.5f));
        EXPECT_GT(g.triangles.size(), 12u + 30u * 4 * 12);
    }
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
