#include <gtest/gtest.h>

#include <set>

#include "experiment/checks/checks.h"
#include "experiment/checks/cost.h"
#include "experiment/scene_setup.h"
#include "experiment/session.h"
#include "experiment_fakes.h"
#include "scene/load.h"
#include "tests/support/errors.h"

using namespace voxray;
using namespace voxray::fakes;

namespace {

SceneSettings settingsOf(const std::string& rest) {
    return parseExperiment("name: x\nscene:\n  builtin: cornell\n  lights: point\n" + rest + "graph: [{pass: a}]\n",
                           "x.yaml")
        .setup.scene;
}

const Material& materialOf(const PreparedScene& prepared, const std::string& name) {
    for (const Material& material : prepared.state.scene->materials)
        if (material.name == name) return material;
    throw Error("no material '{}'", name);
}

/// With a cache of its own.
class SceneSize : public RunTest {};

}  // namespace

TEST(ComposedSceneLoader, HidesWhatGoesByANodesAMeshsOrAMaterialsName) {
    SceneLoader loader({});
    const auto triangles = [&](const std::string& rest) {
        return loader.prepare(settingsOf(rest)).state.geometry.triangles.size();
    };
    const size_t all = triangles("  add: [{builtin: spheres, count: 2}]\n"), cornell = triangles("");
    EXPECT_LT(cornell, all);
    EXPECT_EQ(triangles("  add: [{builtin: spheres, count: 2}]\n  hide: [spheres]\n"), cornell);
    EXPECT_EQ(triangles("  hide: red\n"), cornell - 2);
    EXPECT_EQ(errorOf<UsageError>([&] { triangles("  hide: [red, gren]\n"); }),
              "x.yaml:5: scene.hide: the scene has no node, mesh or material 'gren'; did you mean 'green'?");
    EXPECT_CONTAINS(errorOf<UsageError>([&] { triangles("  hide: {red: 1}\n"); }), "as in [Window, Curtain]");
    EXPECT_NE(loader.key(settingsOf("")), loader.key(settingsOf("  hide: [red]\n")));
}

TEST(ComposedSceneLoader, AddsOverridesAndKeepsItsCamera) {
    SceneLoader loader({});
    const PreparedScene plain = loader.prepare(settingsOf(""));
    const PreparedScene composed = loader.prepare(
        settingsOf("  add:\n    - {builtin: spheres, count: 2, material: {metallic: 1}}\n"
                   "    - {builtin: cornell, lights: spot, boxes: false, transform: {translate: [9, 0, 0]}}\n"
                   "  override:\n    grey: {roughness: 0.25}\n    spheres: {base_color: 0.5}\n"));
    const PreparedScene spheres = loader.prepare(
        parseExperiment("name: x\nscene: {builtin: spheres, count: 2}\ngraph: [{pass: a}]\n", "x").setup.scene);
    EXPECT_GT(composed.state.geometry.triangles.size(),
              plain.state.geometry.triangles.size() + spheres.state.geometry.triangles.size());
    EXPECT_EQ(composed.camera.position, plain.camera.position);
    ASSERT_EQ(composed.state.lights.size(), 3u);
    EXPECT_EQ(composed.state.lights[2].position, glm::vec3(9, 1.8f, 0));

    // Both rooms' grey, and the material that stands in for the spheres'
    int greys = 0;
    for (const Material& material : composed.state.scene->materials) {
        if (material.name != "grey") continue;
        EXPECT_EQ(material.roughness, 0.25f);
        ++greys;
    }
    EXPECT_EQ(greys, 2);
    EXPECT_EQ(materialOf(composed, "spheres").metallic, 1);
    EXPECT_EQ(materialOf(composed, "spheres").baseColor, glm::vec4(0.5f, 0.5f, 0.5f, 1));
    EXPECT_EQ(materialOf(plain, "grey").roughness, 1);

    EXPECT_TRUE(loader.prepare(settingsOf("  keep_file_lights: false\n  add: [{builtin: cornell, lights: spot}]\n"))
                    .state.lights.empty());
}

TEST(ComposedSceneLoader, AScenesOwnTransformTakesItsCameraAlongAndNothingOfTheConfig) {
    SceneLoader loader({});
    const PreparedScene plain = loader.prepare(settingsOf(""));
    const PreparedScene placed =
        loader.prepare(settingsOf("  transform: {translate: [100, 0, 0]}\n  add: [{builtin: plane}]\n"));
    const glm::vec3 way(100, 0, 0);
    EXPECT_EQ(placed.camera.position, plain.camera.position + way);
    EXPECT_EQ(placed.camera.forward, plain.camera.forward);
    EXPECT_EQ(placed.state.lights[0].position, plain.state.lights[0].position + way);
    for (size_t i = 0; i < plain.state.geometry.positions.size(); ++i)
        EXPECT_EQ(placed.state.geometry.positions[i], plain.state.geometry.positions[i] + way);
    EXPECT_EQ(placed.state.geometry.boundsMin.x, -5) << "what is added stays";

    const PreparedScene looked =
        loader.prepare(settingsOf("  transform: {translate: [100, 0, 0]}\n  "
                                  "camera: {position: [0, 1, 4], target: [0, 1, 0]}\n"));
    EXPECT_EQ(looked.camera.position, glm::vec3(0, 1, 4));
}

TEST(ComposedSceneLoader, FarScenesAreRenderedNearTheirCenter) {
    SceneLoader loader({});
    const auto lit = [](const std::string& rest) {
        return parseExperiment("name: x\nscene: {builtin: cornell, " + rest + "}\ngraph: [{pass: a}]\n", "x")
            .setup.scene;
    };
    const SceneSettings far =
        lit("transform: {translate: [10000, 0, -20000]}, lights: [{point: [10000, 1.5, -20000]}]");
    const PreparedScene near = loader.prepare(lit("lights: [{point: [0, 1.5, 0]}]"), Origin::Scene);
    EXPECT_EQ(near.origin, glm::vec3(0));
    const PreparedScene world = loader.prepare(far);
    EXPECT_EQ(world.origin, glm::vec3(0));
    EXPECT_EQ(world.camera.position.x, 10000);

    const PreparedScene own = loader.prepare(far, Origin::Scene);
    // Along y it is not far away: there coordinates are those of the scene at the world's origin
    const glm::vec3 center = 0.5f * (world.state.geometry.boundsMin + world.state.geometry.boundsMax);
    EXPECT_EQ(own.origin, glm::vec3(center.x, 0, center.z));
    const glm::vec3 rest = glm::vec3(10000, 0, -20000) - own.origin;
    const auto& places = own.state.geometry.positions;
    ASSERT_EQ(places.size(), near.state.geometry.positions.size());
    float worst = 0;
    for (size_t i = 0; i < places.size(); ++i)
        worst = std::max(worst, glm::length(places[i] - near.state.geometry.positions[i] - rest));
    EXPECT_LT(worst, 1e-6f) << "as exact as at the world's origin, where floats of 10 km are 1 mm apart";
    EXPECT_LT(glm::length(own.camera.position - near.camera.position - rest), 1e-3f)
        << "a camera without a node has a place in the world, where floats of 10 km are 1 mm apart";
    ASSERT_EQ(own.state.lights.size(), 1u);
    EXPECT_LT(glm::length(own.state.lights[0].position - near.state.lights[0].position - rest), 1e-3f);

    // Frames of a sequence stay there
    PreparedScene moved = loader.prepare(far, Origin::Scene);
    SceneLoader::goToFrame(moved, far, 1);
    EXPECT_EQ(moved.camera.position, own.camera.position);
    EXPECT_EQ(moved.state.lights[0].position, own.state.lights[0].position);
}

TEST(ComposedSceneLoader, LambertLeavesWhatTheConfigSays) {
    SceneLoader loader({});
    const PreparedScene prepared = loader.prepare(
        settingsOf("  materials: lambert\n  add:\n    - {builtin: mirror_room}\n"
                   "    - {builtin: plane, material: {metallic: 1}}\n  override: {red: {specular: 1}}\n"));
    EXPECT_EQ(materialOf(prepared, "mirror").metallic, 0);
    EXPECT_EQ(materialOf(prepared, "plane").metallic, 1);
    EXPECT_EQ(materialOf(prepared, "red").specular, 1);
    EXPECT_EQ(materialOf(prepared, "green").specular, 0);
}

TEST(ComposedSceneLoader, AddedAnimationsPlay) {
    SceneLoader loader({});
    const auto at = [](const char* time) {
        return settingsOf(std::string("  time_step: 0.5\n  time: ") + time +
                          "\n  add: [{builtin: spheres, count: 2, transform: {translate: [0, 1, 0], scale: 0.5}}]\n");
    };
    PreparedScene moved = loader.prepare(at("0"));
    const PreparedScene there = loader.prepare(at("1.5"));
    EXPECT_NE(moved.state.geometry.positions, there.state.geometry.positions);
    EXPECT_EQ(SceneLoader::goToFrame(moved, at("0"), 3).size(), 4u);  // Two spheres, before and after.
    EXPECT_EQ(moved.state.geometry.positions, there.state.geometry.positions);
}

TEST(ComposedSceneLoader, AddedScenesSwing) {
    SceneLoader loader({});
    const auto withPlane = [](const std::string& more) {
        return settingsOf("  time_step: 0.5\n  add: [{builtin: plane, transform: {translate: " + more + "}]\n");
    };
    const SceneSettings start = withPlane("[0, 1, 0]}, swing: {by: [0.4, 0, 0.2], period: 2}");
    PreparedScene moved = loader.prepare(start);
    uint32_t frame = 0;
    for (const char* place : {"[0, 1, 0]}", "[0.4, 1, 0.2]}", "[0, 1, 0]}", "[-0.4, 1, -0.2]}", "[0, 1, 0]}"}) {
        SceneLoader::goToFrame(moved, start, frame++);
        const std::vector<glm::vec3> there = loader.prepare(withPlane(place)).state.geometry.positions;
        ASSERT_EQ(moved.state.geometry.positions.size(), there.size());
        for (size_t i = 0; i < there.size(); ++i)
            EXPECT_LT(glm::length(moved.state.geometry.positions[i] - there[i]), 1e-6f) << place;
    }
}

TEST(ComposedSceneLoader, KeysTellCompositionsApart) {
    SceneLoader loader({});
    std::set<std::string> keys;
    size_t count = 0;
    for (const char* rest :
         {"", "  transform: {scale: 2}\n", "  transform: {translate: [0, 1, 0]}\n", "  add: [{builtin: plane}]\n",
          "  add: [{builtin: plane, albedo: 0.25}]\n", "  add: [{builtin: plane}, {builtin: plane}]\n",
          "  add: [{builtin: plane, transform: {scale: 2}}]\n",
          "  add: [{builtin: plane, transform: {translate: [0, 1, 0]}}]\n", "  add: [{builtin: plane, material: {}}]\n",
          "  add: [{builtin: plane, material: {roughness: 0.5}}]\n",
          "  add: [{builtin: plane, swing: {by: [1, 0, 0]}}]\n",
          "  add: [{builtin: plane, swing: {by: [1, 0, 0], period: 2}}]\n", "  override: {grey: {roughness: 0.5}}\n",
          "  override: {grey: {specular: 1}}\n", "  override: {red: {specular: 1}}\n"}) {
        keys.insert(loader.key(settingsOf(rest)));
        EXPECT_EQ(keys.size(), ++count) << rest;
    }
    EXPECT_EQ(loader.key(settingsOf("  add: []\n  override: {}\n")), loader.key(settingsOf("")));
    EXPECT_EQ(loader.prepare(settingsOf("  add: [{builtin: plane}]\n")).state.scene->contentHash,
              loader.prepare(settingsOf("  add: [{builtin: plane}]\n")).state.scene->contentHash);
    EXPECT_NE(loader.prepare(settingsOf("  add: [{builtin: plane}]\n")).state.scene->contentHash,
              loader.prepare(settingsOf("")).state.scene->contentHash);
}

TEST(ComposedSceneLoader, ErrorsNamePlaceAndNearestWord) {
    SceneLoader loader({});
    const auto expectError = [&](const std::string& rest, const char* place, const char* name) {
        const std::string error = errorOf<UsageError>([&] { loader.key(settingsOf(rest)); });
        EXPECT_CONTAINS(error, place);
        EXPECT_CONTAINS(error, name);
    };
    expectError("  override:\n    red: {specular: 1}\n    graey: {specular: 1}\n", "x.yaml:7: ", "'grey'");
    expectError("  add: [{builtin: plane, material: {}}]\n  override: {plan: {specular: 1}}\n",
                "x.yaml:6: ", "'plane'");
    expectError("  add: [{builtin: plan}]\n", "x.yaml:5: scene.add[0].builtin: ", "'plane'");
    expectError("  add: [{builtin: plane, heigth: 2}]\n", "x.yaml:5: scene.add[0]: ", "'height'");
    expectError("  add: [{builtin: plane, matrial: {}}]\n", "x.yaml:5: ", "'material'");
    expectError("  add: [{builtin: plane, swing: {period: 2}}]\n", "x.yaml:5: scene.add[0].swing: ", "without 'by'");
    expectError("  add: [{file: nowhere.glb}]\n", "x.yaml:5: ", "'nowhere.glb'");
}

TEST_F(RunTest, ComposedScenesHaveReferencesOfTheirOwn) {
    const std::string sweep =
        "sweep:\n  scene.add: [[], [{builtin: plane}]]\n  scene.override: [{grey: {roughness: 0}}, null]\n";
    EXPECT_EQ(run(sweep).ok, 4u);
    EXPECT_EQ(Truth::runs, 4);
    EXPECT_EQ(run(sweep).ok, 4u);
    EXPECT_EQ(Truth::runs, 4);
    EXPECT_EQ(cell("add-plane-override-null", "scene.add"), "plane");
}

TEST_F(RunTest, ChainsOfPassesRunInPlaceOfOne) {
    const std::string graph = "graph: [{pass: constant, id: c}]\n";
    const Experiment experiment =
        parseExperiment("name: fake\nscene: {builtin: cornell, lights: point}\nimage: {width: 8, height: 4}\n" + graph +
                            "reference: {pass: truth}\nmeasure: {frames: 3, warmup: 1}\n"
                            "sweep:\n  c: [constant, [witness, {pass: constant, value: 0.5}]]\n",
                        "fake.yaml");
    EXPECT_EQ(runExperiment(experiment, options(), registry()).ok, 2u);
    EXPECT_NEAR(std::stod(cell("constant-value-0.5", "nrmse")), 0.5, 1e-6);
    EXPECT_CONTAINS(readTextFile(root_ / "out" / "passes.csv"), "constant-value-0.5,witness,build,");
    EXPECT_CONTAINS(readTextFile(root_ / "out" / "passes.csv"), "constant-value-0.5,c,frame,");
}

TEST(ComposedSceneLoader, WarnsOfAdditionsInAnotherUnit) {
    const auto saidOf = [](const std::string& additions) {
        SceneLoader loader({});
        const SceneSettings scene = settingsOf("  add: [" + additions + "]\n");
        std::vector<std::string> lines;
        for (const Diagnostic& found : checkAddedSceneUnits(scene, loader.prepare(scene), loader))
            lines.push_back(found.str());
        return lines;
    };
    const auto room = [](const std::string& transform) {
        return "{builtin: white_room, transform: {" + transform + "}}";  // As large as the Cornell box.
    };
    EXPECT_TRUE(saidOf(room("scale: 99") + ", " + room("scale: 0.0101")).empty());
    EXPECT_TRUE(saidOf("{builtin: plane, transform: {scale: 1000}}").empty()) << "a ground has any size";
    EXPECT_TRUE(saidOf(room("translate: [340, 0, 0]")).empty());

    const std::vector<std::string> said = saidOf(room("scale: 101") + ", " + room("scale: 2") + ", " +
                                                 room("scale: 0.0099") + ", " + room("translate: [0, 0, -350]"));
    ASSERT_EQ(said.size(), 3u);
    EXPECT_CONTAINS(said[0], "x.yaml:5: scene.add[0]: ");
    EXPECT_CONTAINS(said[0], "transform: {scale: 1.01}");
    EXPECT_CONTAINS(said[1], "scene.add[2]: ");
    EXPECT_CONTAINS(said[1], "transform: {scale: 0.99}");
    EXPECT_CONTAINS(said[2], "scene.add[3]: ");
    EXPECT_CONTAINS(said[2], "and 348 m away");

    // Where objects of the scene or of what is added are hidden, the others keep their sources
    SceneLoader loader({});
    const SceneSettings hidden = settingsOf("  hide: [red, sphere]\n  add: [" + room("scale: 2") + ", " +
                                            room("scale: 101") + ", {builtin: mirror_row}]\n");
    const Diagnostics rest = checkAddedSceneUnits(hidden, loader.prepare(hidden), loader);
    ASSERT_EQ(rest.size(), 1u);
    EXPECT_CONTAINS(rest[0].str(), "scene.add[1]: ");
}

TEST_F(SceneSize, AdviceNamesWhatTheLargestPartGrowsWith) {
    SceneLoader loader({});
    const auto adviceOn = [&](const SceneSettings& settings) {
        return sceneSizeAdvice(settings, loader.prepare(settings).state);
    };
    EXPECT_CONTAINS(adviceOn(settingsOf("  subdivide: 1\n  add: [{builtin: mirror_row}]\n")),
                    ": lower scene.subdivide, or place fewer copies in scene.add, or take another --device");
    const SceneSettings row =
        parseExperiment("name: x\nscene: {builtin: mirror_row}\ngraph: [{pass: a}]\n", "x").setup.scene;
    EXPECT_CONTAINS(adviceOn(row), ": lower scene.count, or take another --device");

    // Textures and a map that take more than triangles
    PreparedScene prepared = loader.prepare(row);
    auto scene = std::make_shared<Scene>(*prepared.state.scene);
    for (const uint32_t width : {512u, 2048u})
        scene->textures.push_back({fmt::format("bark {}", width), width, 512,
                                   std::vector<uint8_t>(size_t(width) * 512 * 4), true, Wrap::Repeat, Wrap::Repeat});
    prepared.state.scene = scene;
    EXPECT_CONTAINS(sceneSizeAdvice(row, prepared.state),
                    ": make its textures smaller; the largest is 'bark 2048' of 2048 x 512, or take");
    // 16 bytes a texel, and 4 of the distribution that rays follow
    scene->environment.map = std::make_shared<const ImageF>(2048u, 1024u, 3u);
    EXPECT_CONTAINS(sceneSizeAdvice(row, prepared.state),
                    "its environment 40.0 MiB: take a smaller map for scene.environment");
}

TEST_F(SceneSize, ASceneThatTheDeviceHasNoRoomForIsToldWithAdvice) {
    Session session({}, test::sourceRoot(), {});
    const voxray::Setup setup =
        parseExperiment("name: x\nscene: {builtin: cornell, subdivide: 4}\ngraph: [{pass: a}]\n", "x.yaml").setup;
    const uint64_t limit = session.device().memoryLimitBytes();
    session.device().setMemoryLimitBytes(session.device().memoryUsedBytes() + 1024);
    const std::string error = errorOf([&] { session.scene(setup); });
    EXPECT_CONTAINS(error, "x.yaml:2: scene: ");
    EXPECT_CONTAINS(error, "its 9216 triangles take ");
    EXPECT_CONTAINS(error, "lower scene.subdivide");

    // With room again it is there
    session.device().setMemoryLimitBytes(limit);
    EXPECT_EQ(session.scene(setup).gpu.triangleCount, 9216u);
}

TEST_F(SceneSize, ScenesStayOnTheDeviceAsLongAsTheyFit) {
    Session session({}, test::sourceRoot(), {});
    const auto setupOf = [](const std::string& scene) {
        return parseExperiment("name: x\nscene: {" + scene + "}\ngraph: [{pass: a}]\n", "x.yaml").setup;
    };
    const voxray::Setup first = setupOf("builtin: cornell, subdivide: 4"),
                        second = setupOf("builtin: cornell, subdivide: 4, override: {red: {metallic: 1}}");
    const auto usedWith = [&](const voxray::Setup& setup) {
        session.scene(setup);
        return session.device().memoryUsedBytes();
    };
    const uint64_t oneBytes = usedWith(first);
    EXPECT_EQ(usedWith(second), oneBytes) << "one by default";

    session.keepScenes(2);
    const RayTracer* tracer = session.scene(second).tracer.get();
    const uint64_t bothBytes = usedWith(first);
    EXPECT_GT(bothBytes, 3 * oneBytes / 2);
    EXPECT_EQ(session.scene(second).tracer.get(), tracer);
    session.keepScenes(1);
    EXPECT_EQ(session.device().memoryUsedBytes(), oneBytes);
    EXPECT_EQ(session.scene(second).tracer.get(), tracer);

    // The one makes room for another that would not fit beside it
    session.keepScenes(2);
    session.device().setMemoryLimitBytes(bothBytes - 1);
    EXPECT_EQ(usedWith(first), oneBytes);
}
