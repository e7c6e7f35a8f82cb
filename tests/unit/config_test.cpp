#include "config/config.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/files.h"
#include "config/camera_path.h"
#include "config/overrides.h"
#include "config/yaml.h"
#include "tests/support/errors.h"

using namespace voxray;

namespace {

const char* const kValid = R"(name: demo
scene:
  builtin: cornell
  lights: point
  camera: {position: [0, 1, 4], target: [0, 1, 0], fov_deg: 40}
image: {width: 64, height: 32}
seed: 7
graph:
  - {pass: gbuffer}
  - {pass: voxelize, resolution: 64}
  - {pass: inject_light_rays, id: inject, rays_per_light: 100}
reference: {pass: path_trace, spp: 16}
sweep:
  voxelize.resolution: [32, 64]
measure: {frames: 2, metrics: [flip, relmse]}
profiles:
  small:
    image: {width: 16}
    reference.spp: 4
    sweep.voxelize.resolution: [8, 16]
    sweep.inject.rays_per_light: [1, 2]
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string configError(const std::string& yaml, const ConfigOptions& options = {}) {
    return errorOf<UsageError>([&] { parseExperiment(yaml, "demo.yaml", options); });
}

void expectError(const std::string& yaml, std::initializer_list<const char*> parts, const ConfigOptions& options = {}) {
    const std::string message = configError(yaml, options);
    for (const char* part : parts) EXPECT_CONTAINS(message, part) << "'" << message << "'";
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

}  // namespace

TEST(Config, ReadsEveryBlock) {
    const Experiment e = parseExperiment(kValid, "demo.yaml");
    EXPECT_EQ(e.setup.general.name, "demo");
    EXPECT_EQ(e.setup.general.seed, 7u);
    EXPECT_EQ(e.setup.scene.source.builtin, "cornell");
    EXPECT_EQ(e.setup.scene.source.builtinParameters.find("lights")->scalar, "point");
    EXPECT_TRUE(e.setup.scene.lights.empty());
    EXPECT_FLOAT_EQ(e.setup.scene.camera->fovDegrees, 40);
    EXPECT_EQ(e.setup.image.width, 64u);
    EXPECT_EQ(e.measure.frames, 2u);
    EXPECT_EQ(e.measure.metrics, (std::vector<std::string>{"flip", "relmse"}));
    EXPECT_EQ(e.setup.graph.items.size(), 3u);
    EXPECT_EQ(e.sweep.members.size(), 1u);
    EXPECT_EQ(e.config.find("profiles"), nullptr);
}

TEST(Config, ErrorsNamePlaceAndNearestWord) {
    expectError(replaced(kValid, "image:", "imgae:"), {"demo.yaml:6: ", "'image'"});
    expectError(replaced(kValid, "width: 64", "widht: 64"), {"demo.yaml:6: ", "'width'"});
    expectError(replaced(kValid, "width: 64", "width: wide"), {"demo.yaml:6: ", "whole number"});
    expectError(replaced(kValid, "width: 64", "width: 0"), {"demo.yaml:6: ", "out of range [1, 8192]"});
    expectError(replaced(kValid, "width: 64", "width: -3"), {"demo.yaml:6: ", "out of range"});
    expectError(replaced(kValid, "seed: 7", "seed: .nan"), {"demo.yaml:7: ", "whole number"});
    expectError(replaced(kValid, "fov_deg", "fov_degree"), {"demo.yaml:5: ", "'fov_deg'"});
    expectError(replaced(kValid, "relmse]", "relmsee]"), {"demo.yaml:15: ", "'relmse'"});
    expectError(replaced(kValid, "[32, 64]", "64"), {"demo.yaml:14: ", "list of values"});
    expectError(replaced(kValid, "name: demo", "name: ../demo"), {"demo.yaml:1: ", "can't name a folder"});
    expectError(replaced(kValid, "builtin: cornell", "builtin: cornell\n  file: a.glb"), {"both"});
    expectError(replaced(kValid, "id: inject", "id: image"), {"demo.yaml:11: ", "key of the config"});
    expectError(replaced(kValid, "target: [0, 1, 0]", "target: [0, 1, 4]"), {"demo.yaml:5: ", "same point"});
    expectError(replaced(kValid, "position: [0, 1, 4]", "position: [0, .inf, 4]"), {"demo.yaml:5: ", "number"});
    expectError(replaced(kValid, "graph:", "measure: {}\ngraph:"), {"demo.yaml:16: ", "appears twice"});
    expectError("name: x\n", {"demo.yaml:1: ", "'scene'"});
    expectError("", {"demo.yaml:1: "});
    expectError("[1, 2]", {"demo.yaml:1: ", "a config is a map"});
}

TEST(Config, Lights) {
    const auto withLights = [](const std::string& lights) {
        return "name: x\nscene:\n  file: a.glb\n  lights:\n" + lights + "graph: [{pass: a}]\n";
    };
    const Experiment e = parseExperiment(
        withLights("    - {directional: [0, -2, 0], irradiance: [10, 9, 8]}\n"
                   "    - {point: [1, 2, 3], intensity: 5}\n"
                   "    - {spot: [0, 1, 0], direction: [0, 0, 3], intensity: 2, inner_deg: 10, outer_deg: 30}\n"),
        "x");
    ASSERT_EQ(e.setup.scene.lights.size(), 3u);
    EXPECT_EQ(e.setup.scene.lights[0].light.type, LightType::Directional);
    EXPECT_EQ(e.setup.scene.lights[0].light.direction, glm::vec3(0, -1, 0));
    EXPECT_EQ(e.setup.scene.lights[1].light.intensity, glm::vec3(5.0f));
    EXPECT_EQ(e.setup.scene.lights[2].light.direction, glm::vec3(0, 0, 1));
    EXPECT_NEAR(e.setup.scene.lights[2].light.outerConeAngle, 0.5235988f, 1e-6f);

    expectError(withLights("    - {piont: [0, 0, 0]}\n"), {"demo.yaml:5: ", "'point'"});
    expectError(withLights("    - {directional: [0, 0, 0]}\n"), {"demo.yaml:5: ", "must not be zero"});
    expectError(withLights("    - {spot: [0, 0, 0], inner_deg: 50}\n"), {"demo.yaml:5: ", "inner_deg"});
    expectError(withLights("    - {point: [0, 0, 0], irradiance: 3}\n"), {"demo.yaml:5: ", "'irradiance'"});
    expectError(withLights("    - {point: [0, 0, 0], intensity: -3}\n"), {"demo.yaml:5: ", "out of range"});
}

TEST(Config, Motion) {
    const auto with = [](const std::string& scene) {
        return "name: x\nscene:\n  file: a.glb\n" + scene + "graph: [{pass: a}]\n";
    };
    const SceneSettings still = parseExperiment(with(""), "x").setup.scene;
    EXPECT_FALSE(changesInTime(still));
    EXPECT_FALSE(still.movingSpheres);
    const SceneSettings moving =
        parseExperiment(with("  time_step: 0.1\n  moving_spheres: {count: 27, swing: [0, 2, 0], albedo: 0.25}\n"), "x")
            .setup.scene;
    EXPECT_TRUE(changesInTime(moving));
    EXPECT_FALSE(changesInTime(moving, false)) << "a time step without anything animated";
    EXPECT_EQ(moving.options.timeStep, 0.1);
    ASSERT_TRUE(moving.movingSpheres);
    EXPECT_EQ(moving.movingSpheres->count, 27u);
    EXPECT_EQ(moving.movingSpheres->swing, glm::vec3(0, 2, 0));
    EXPECT_EQ(moving.movingSpheres->albedo, glm::vec3(0.25f));
    const SceneSettings lamp =
        parseExperiment(with("  lights: [{point: [0, 0, 0], move: [1, 0, 0]}]\n"), "x").setup.scene;
    EXPECT_TRUE(changesInTime(lamp));
    EXPECT_TRUE(changesInTime(lamp, false));
    EXPECT_EQ(lamp.lights[0].move, glm::vec3(1, 0, 0));

    expectError(with("  time_step: -1\n"), {"demo.yaml:4: ", "out of range"});
    expectError(with("  moving_spheres: {cuont: 9}\n"), {"demo.yaml:4: ", "'count'"});
    expectError(with("  moving_spheres: {period: 0}\n"), {"demo.yaml:4: ", "out of range"});
    expectError(with("  moving_spheres: 9\n"), {"demo.yaml:4: ", "scene.moving_spheres"});
    expectError(with("  moving_sphere: {count: 9}\n"), {"demo.yaml:4: ", "'moving_spheres'"});
    expectError(with("  lights: [{point: [0, 0, 0], move: 3 m}]\n"), {"demo.yaml:4: ", "scene.lights[0].move"});
}

TEST(Config, CameraPath) {
    const auto with = [](const std::string& keys) {
        return "name: x\nscene:\n  file: a.glb\n  camera:\n    position: [0, 0, 4]\n    target: [0, 0, 3]\n" + keys +
               "graph: [{pass: a}]\n";
    };
    const auto cameraWith = [&](const std::string& path) {
        return *parseExperiment(with("    path: " + path + "\n"), "x").setup.scene.camera;
    };
    EXPECT_FALSE(cameraMoves(cameraWith("[]")));
    EXPECT_FALSE(cameraMoves(cameraWith("null")));
    const CameraSettings camera = cameraWith(
        "[{frame: 4, position: [2, 0, 4], target: [2, 0, 3]}, {frame: 6, position: [2, 0, 4], target: [3, 0, 3]}]");
    EXPECT_TRUE(cameraMoves(camera));
    EXPECT_TRUE(cameraOnPath(camera, 1).path.empty());
    const auto at = [&](int frame) {
        const CameraSettings moved = cameraOnPath(camera, frame);
        return std::pair(moved.position, moved.target);
    };
    EXPECT_EQ(at(-2), std::pair(camera.position, camera.target));
    EXPECT_EQ(at(0), at(-2));
    EXPECT_EQ(at(1), std::pair(glm::vec3(0.5f, 0, 4), glm::vec3(0.5f, 0, 3)));
    EXPECT_EQ(at(4), std::pair(glm::vec3(2, 0, 4), glm::vec3(2, 0, 3)));
    EXPECT_EQ(at(5), std::pair(glm::vec3(2, 0, 4), glm::vec3(2.5f, 0, 3)));
    EXPECT_EQ(at(6), std::pair(glm::vec3(2, 0, 4), glm::vec3(3, 0, 3)));
    EXPECT_EQ(at(99), at(6));

    const auto error = [&](const std::string& path, std::initializer_list<const char*> parts) {
        expectError(with("    path: " + path + "\n"), parts);
    };
    error("3", {"demo.yaml:7: ", "scene.camera.path: expected a list"});
    error("[{frame: 1, position: [0, 0, 4]}]", {"demo.yaml:7: ", "scene.camera.path[0]: 'target' is missing"});
    error("[{frame: 0, position: [0, 0, 4], target: [0, 0, 0]}]", {"path[0].frame", "out of range"});
    error("[{frame: 1, position: [0, 0, 4], target: [0, 0, 0], up: [0, 0, 1]}]", {"'up'"});
    error("[{frame: 2, position: [0, 0, 4], target: [1, 0, 0]}, {frame: 2, position: [0, 0, 4], target: [0, 0, 0]}]",
          {"path[1]: frame 2 does not come after frame 2"});
    error("[{frame: 2, position: [0, 0, 4], target: [0, 0, 4]}]", {"path[0]: ", "or nowhere"});
    error("[{frame: 2, position: [0, 0, 4], target: [0, 2, 4]}]", {"path[0]: ", "its own 'up'"});
    error("[{frame: 2, position: [0, 0, 4], target: [0, 0, 5]}]", {"path[0]: ", "give another key"});
    expectError(with("    move: [0, 0, 1]\n    path: [{frame: 2, position: [0, 0, 4], target: [1, 0, 0]}]\n"),
                {"demo.yaml:8: ", "'move'"});
}

TEST(Config, Environment) {
    const auto with = [](const std::string& environment) {
        return parseExperiment("name: x\nscene: {file: a.glb, environment: " + environment + "}\ngraph: [{pass: a}]",
                               "x")
            .setup.scene.environment;
    };
    EXPECT_EQ(with("none")->scale, glm::vec3(0.0f));
    EXPECT_EQ(with("0.5")->scale, glm::vec3(0.5f));
    EXPECT_EQ(with("[1, 2, 3]")->scale, glm::vec3(1, 2, 3));
    EXPECT_EQ(with("sky.exr")->map, "sky.exr");
    EXPECT_EQ(with("{map: sky.exr, scale: 2}")->scale, glm::vec3(2.0f));
    EXPECT_THROW(with("{mpa: sky.exr}"), UsageError);
    EXPECT_THROW(with("{scale: 2}"), UsageError);
    EXPECT_THROW(with("{}"), UsageError);
}

TEST(Config, ProfileMergesMapsAndFollowsPaths) {
    const Experiment e = parseExperiment(kValid, "demo.yaml", {"small", {}});
    EXPECT_EQ(e.setup.image.width, 16u);
    EXPECT_EQ(e.setup.image.height, 32u);
    EXPECT_EQ(e.reference.find("spp")->scalar, "4");
    EXPECT_EQ(e.sweep.find("voxelize.resolution")->text(), "[8, 16]");
    EXPECT_EQ(e.sweep.find("inject.rays_per_light")->text(), "[1, 2]");

    expectError(kValid, {"demo.yaml:16: ", "'small'"}, {"smal", {}});
    // A broken profile is found without being asked for
    expectError(replaced(kValid, "reference.spp", "referense.spp"), {"demo.yaml:19: ", "'reference'"});
    expectError(replaced(kValid, "image: {width: 16}", "image: {widht: 16}"), {"demo.yaml:18: ", "'width'"});
}

TEST(Config, NullTakesANamedValueOutOfAnAxis) {
    const std::string named = replaced(kValid, "  voxelize.resolution: [32, 64]\n",
                                       "  voxelize.resolution: {low: 32, \"a.b: c\": 48, high: 64}\n");
    const auto axis = [&](const std::string& change) {
        return parseExperiment(named, "demo.yaml", {"", {change}}).sweep.find("voxelize.resolution")->text();
    };
    EXPECT_EQ(axis("sweep.voxelize.resolution={low: null}"), "{a.b: c: 48, high: 64}");
    EXPECT_EQ(axis("sweep={voxelize.resolution: {\"a.b: c\": null, low: 8, top: 128}}"),
              "{low: 8, high: 64, top: 128}");
    EXPECT_EQ(axis("sweep.voxelize.resolution={low: 8}"), "{low: 8}");
    const std::string profile =
        replaced(named, "    sweep.voxelize.resolution: [8, 16]\n", "    sweep.voxelize.resolution: {low: null}\n");
    EXPECT_EQ(parseExperiment(profile, "demo.yaml", {"small", {}}).sweep.find("voxelize.resolution")->members.size(),
              2u);
    expectError(named, {"no 'lo'", "'low'"}, {"", {"sweep.voxelize.resolution={lo: null}"}});
    expectError(named, {"no 'low'"}, {"", {"sweep.seed={low: null}"}});
    expectError(named, {"no such axis"}, {"", {"sweep.seed={high: 64, low: null}"}});
    expectError(kValid, {"no 'low'"}, {"", {"sweep.voxelize.resolution={low: null}"}});
    // By a path
    EXPECT_EQ(axis("sweep.voxelize.resolution.low=null"), "{a.b: c: 48, high: 64}");
    EXPECT_EQ(axis("sweep.voxelize.resolution.a.b: c=null"), "{low: 32, high: 64}");
    EXPECT_EQ(axis("sweep.voxelize.resolution.low=8"), "{low: 8, a.b: c: 48, high: 64}");
    for (const char* change : {"sweep.voxelize.resolution.lo=null", "sweep.voxelize.resolution.loww=null"})
        expectError(named, {"has none of that name", "'voxelize.resolution.low'"}, {"", {change}});
    expectError(kValid, {"has none of that name"}, {"", {"sweep.inject.write=null"}});
    expectError(kValid, {"'width:96'", "'width: 96'"}, {"", {"image={width:96}"}});
}

TEST(Config, Assignments) {
    const Experiment e = parseExperiment(
        kValid, "demo.yaml",
        {"",
         {"voxelize.resolution=128", "image.width=320", "reference.spp=3", "scene.camera.fov_deg=50",
          "inject={pass: inject_rsm, write: max}", "sweep.voxelize.resolution=null", "measure={frames: 9}"}});
    EXPECT_EQ(e.setup.graph.items[1].find("resolution")->scalar, "128");
    EXPECT_EQ(e.setup.image.width, 320u);
    EXPECT_EQ(e.reference.find("spp")->scalar, "3");
    EXPECT_FLOAT_EQ(e.setup.scene.camera->fovDegrees, 50);
    EXPECT_FLOAT_EQ(e.setup.scene.camera->position.z, 4);
    EXPECT_EQ(e.setup.graph.items[2].text(), "{pass: inject_rsm, write: max, id: inject}");
    EXPECT_TRUE(e.sweep.members.empty());
    EXPECT_EQ(e.measure.frames, 9u);
    EXPECT_EQ(e.measure.metrics.size(), 2u);
    EXPECT_TRUE(parseExperiment(kValid, "x", {"", {"reference=null"}}).reference.isNull());

    // A chain of passes
    const Experiment chain =
        parseExperiment(kValid, "x", {"", {"inject=[place_surfels, {pass: inject_voxel_rays}]", "inject.bounces=2"}});
    ASSERT_EQ(chain.setup.graph.items.size(), 4u);
    EXPECT_EQ(chain.setup.graph.items[2].text(), "{pass: place_surfels}");
    EXPECT_EQ(chain.setup.graph.items[3].text(), "{pass: inject_voxel_rays, id: inject, bounces: 2}");

    expectError(kValid, {"--set voxelise.resolution=1: ", "'voxelize'"}, {"", {"voxelise.resolution=1"}});
    expectError(kValid, {"--set image.widht=1: ", "'width'"}, {"", {"image.widht=1"}});
    expectError(kValid, {"--set image.width=wide: "}, {"", {"image.width=wide"}});
    expectError(kValid, {"path=value"}, {"", {"image.width"}});
    expectError(kValid, {"--set image.width=[", "bad YAML"}, {"", {"image.width=["}});
    expectError(kValid, {"has no keys"}, {"", {"seed.x=1"}});
}

TEST(Config, MasksAndComparedFramesAreChecked) {
    const auto with = [](const std::string& assignment) { return ConfigOptions{"", {assignment}}; };
    const Experiment e =
        parseExperiment(kValid, "x", with("measure.masks={floor: {material: stone}, mirrors: {max_roughness: 0.1}}"));
    ASSERT_EQ(e.measure.masks.size(), 2u);
    EXPECT_EQ(e.measure.masks[0].name, "floor");
    EXPECT_EQ(e.measure.masks[0].material, "stone");
    EXPECT_FLOAT_EQ(e.measure.masks[1].maxRoughness, 0.1f);
    EXPECT_EQ(comparedFrames(e.measure), 1u);

    expectError(kValid, {"measure.masks: expected a map"}, with("measure.masks=[floor]"));
    expectError(kValid, {"measure.masks: 'a b' can't name a mask"}, with("measure.masks={a b: {material: x}}"));
    expectError(kValid, {"measure.masks.floor: expected conditions"}, with("measure.masks={floor: {}}"));
    expectError(kValid, {"'material'"}, with("measure.masks={floor: {materail: x}}"));
    expectError(kValid, {"max_roughness"}, with("measure.masks={floor: {max_roughness: 2}}"));
    expectError(kValid, {"measure.compare_every: 1 compares 2 of 2 frames; temporal error needs at least 3"},
                with("measure.compare_every=1"));
    MeasureSettings measure;
    measure.frames = 10;
    measure.compareEvery = 3;
    EXPECT_EQ(comparedFrames(measure), 4u);  // 0, 3, 6, 9
}

TEST(Config, BlocksWithoutEffectAreRefusedInTheFileAlone) {
    const std::string alone = replaced(kValid, "reference: {pass: path_trace, spp: 16}\n", "");
    const std::string uncompared = replaced(alone, "    reference.spp: 4\n", "");
    expectError(uncompared, {"demo.yaml:14: ", "'reference'"});
    // A profile or the command line may bring one, and take one out
    parseExperiment(replaced(uncompared, "    image:", "    reference: {pass: path_trace}\n    image:"), "x");
    parseExperiment(uncompared, "x", {"", {"reference={pass: path_trace}"}});
    parseExperiment(kValid, "x", {"", {"reference=null"}});

    const std::string empty = replaced(kValid, "sweep:\n  voxelize.resolution: [32, 64]\n", "sweep: {}\n");
    expectError(empty, {"demo.yaml:13: ", "sweep: an empty map varies nothing"});
    parseExperiment(kValid, "x", {"", {"sweep.voxelize.resolution=null"}});
}

TEST(Config, AnAxisWhoseOneValueIsWrittenIsWarnedOf) {
    const auto warnings = [](const std::string& axis, const ConfigOptions& options = {}) {
        return parseExperiment(replaced(kValid, "voxelize.resolution: [32, 64]", axis), "demo.yaml", options).warnings;
    };
    ASSERT_EQ(warnings("voxelize.resolution: [64]").size(), 1u);
    EXPECT_CONTAINS(warnings("voxelize.resolution: [64]")[0], "demo.yaml:14: sweep.voxelize.resolution: ");
    EXPECT_EQ(warnings("scene.camera.fov_deg: {as it is: 40}").size(), 1u);
    EXPECT_EQ(warnings("gbuffer: [gbuffer]").size(), 1u);
    EXPECT_EQ(warnings("gbuffer: [{pass: gbuffer}]").size(), 1u);
    // A pass that another axis replaces does not have the value that is written in the graph
    EXPECT_TRUE(warnings("voxelize: [voxelize, {pass: voxelize, method: msaa}]\n  voxelize.resolution: [64]").empty());

    // Another value, a pass without the written one's parameters, what a profile or --set makes of it
    for (const char* other : {"voxelize.resolution: [64, 128]", "voxelize.resolution: [65]", "voxelize.method: [exact]",
                              "inject: [inject_light_rays]", "gbuffer: [[gbuffer]]", "scene.lights: [[]]"})
        EXPECT_TRUE(warnings(other).empty()) << other;
    const std::string several = "voxelize.resolution: [32, 64]";
    EXPECT_TRUE(warnings(several, {"", {"sweep.voxelize.resolution=[64]"}}).empty());
    EXPECT_EQ(warnings("voxelize.resolution: [64]", {"", {"image.width=8"}}).size(), 1u);
    EXPECT_TRUE(warnings("voxelize.resolution: [64]", {"small", {}}).empty());
}

TEST(Config, PlacesOfPaths) {
    const Value config = parseExperiment(kValid, "demo.yaml").config;
    EXPECT_EQ(locationOf(config, "scene.camera.fov_deg").line, 5);
    EXPECT_EQ(locationOf(config, "scene.lights").line, 4);
    EXPECT_EQ(locationOf(config, "scene.time_step").line, locationOf(config, "scene").line);
}
