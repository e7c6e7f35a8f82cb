#include "experiment/checks/view.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "passes/path_trace/preview.h"
#include "scene/load.h"
#include "tests/support/errors.h"

namespace voxray {
namespace {

ViewCheck checkOf(const std::string& scene, int exposureStops, const std::string& graph) {
    const Experiment experiment =
        parseExperiment(fmt::format("name: x\nscene: {{{}}}\nimage: {{width: 64, height: 36, exposure_stops: {}}}\n"
                                    "graph: {}\n",
                                    scene, exposureStops, graph),
                        "x.yaml");
    SceneLoader loader({});
    return checkView(experiment.setup, loader.prepare(experiment.setup.scene), pathTracedPreview);
}

/// What is said of a scene's view.
std::string saidOf(const std::string& scene, int exposureStops = 0, const std::string& graph = "[{pass: gbuffer}]") {
    std::vector<std::string> lines;
    for (const Diagnostic& found : checkOf(scene, exposureStops, graph).found) lines.push_back(found.str());
    return fmt::format("{}", fmt::join(lines, " | "));
}

std::string refusalOf(const std::string& scene) {
    return errorOf<UsageError>([&] { saidOf(scene); });
}

TEST(ViewCheck, SaysNothingOfBuiltInScenesButThoseThatAreDarkByIntention) {
    for (const std::string& name : builtinSceneNames()) {
        const std::string said = saidOf("builtin: " + name);
        const bool isDark = name == "thin_wall" || name == "shell_room";
        EXPECT_EQ(said.empty(), !isDark) << name << ": " << said;
    }
    EXPECT_EQ(saidOf("builtin: thin_wall, view: lit"), "");
    EXPECT_EQ(saidOf("builtin: shell_room, light: inside"), "");
}

TEST(ViewCheck, TellsHowMuchOfTheViewIsMetal) {
    // Half a metal counts half; what a config says of a material stands above its mode.
    const auto metalOf = [](const std::string& scene) {
        return checkOf(scene, 0, "[{pass: gbuffer}]").visibleMetalFraction;
    };
    const std::string plane = "builtin: plane, override: {ground: {metallic: ";
    EXPECT_NEAR(metalOf(plane + "1}}"), 1, 1e-6);
    EXPECT_NEAR(metalOf(plane + "0.5}}"), 0.5, 1e-6);
    EXPECT_EQ(metalOf(plane + "1}}, materials: lambert"), 1);
    EXPECT_EQ(metalOf("builtin: mirror_room, materials: lambert"), 0);
    EXPECT_GT(metalOf("builtin: mirror_room"), 0.1);
}

TEST(ViewCheck, RefusesDarkBacks) {
    const char* outside[] = {// Outside of a closed room, behind the open box, below a plane that is lit from above
                             "builtin: white_room, camera: {position: [0, 1, 9], target: [0, 1, 0]}",
                             "builtin: cornell, lights: point, camera: {position: [0, 1, -4], target: [0, 1, 0]}",
                             "builtin: plane, camera: {position: [0, -2, 0.1], target: [0, 0, 0]}"};
    for (const char* scene : outside) {
        const std::string message = refusalOf(scene);
        EXPECT_CONTAINS(message, "x.yaml:2: ");
        EXPECT_CONTAINS(message, "the backs of surfaces, and no light");
        EXPECT_CONTAINS(message, "./voxray scene ");
    }
    // Inside of the taller box
    EXPECT_CONTAINS(refusalOf("builtin: cornell, camera: {position: [-0.35, 0.6, -0.3], target: [0, 0.6, 0]}"),
                    "inside of a solid");
    EXPECT_CONTAINS(refusalOf("builtin: cornell, camera: {position: [0, 1, 3], target: [0, 1, 9]}"),
                    "no surface lies in its view");
}

TEST(ViewCheck, AllowsBacksThatAreLit) {
    EXPECT_EQ(saidOf("builtin: white_room, environment: 1, camera: {position: [0, 1, 9], target: [0, 1, 0]}"), "");
}

TEST(ViewCheck, FindsLightThatFewPathsMeet) {
    // A spot of two degrees on a part of the ceiling
    EXPECT_EQ(saidOf("builtin: white_room, keep_file_lights: false, lights: [{spot: [0, 0, 0], direction: "
                     "[0, 1, 0.2], intensity: 100000, outer_deg: 2}]"),
              "");
}

TEST(ViewCheck, WarnsOfCamerasThatSeeHardlyAnything) {
    const std::string far = saidOf("builtin: cornell, camera: {position: [0, 1, 31], target: [0, 1, 0], fov_deg: 60}");
    EXPECT_CONTAINS(far, "x.yaml:2: ");
    EXPECT_CONTAINS(far, "fill less than 1 % of its view: it stands at [0, 1, 31], 30 m away");
    EXPECT_CONTAINS(far, "from [-1, 0, -1] to [1, 2, 1]");
    // A telescope sees enough from there
    EXPECT_EQ(saidOf("builtin: cornell, camera: {position: [0, 1, 31], target: [0, 1, 0], fov_deg: 5}"), "");
    const std::string radians =
        saidOf("builtin: cornell, camera: {position: [0, 1, 3.8], target: [0, 1, 0], fov_deg: 1.05}");
    EXPECT_CONTAINS(radians, "fov_deg: 1.05 degrees are a telescope's; 1.05 in radians is 60.16 degrees");
}

TEST(ViewCheck, WarnsOfLightsThatLightNothing) {
    const auto saidOfLight = [](const std::string& light) {
        return saidOf("builtin: cornell, lights: [" + light + "]");
    };
    const std::string nothing = "scene.lights[0]: it lights nothing", backs = "the backs of surfaces alone";
    EXPECT_CONTAINS(saidOfLight("{spot: [0, 1, 3], direction: [0, 0, 1]}"), nothing);
    // From below the boxes' bottoms coincide with the floor, whose back hides them
    EXPECT_CONTAINS(saidOf("builtin: cornell, boxes: false, lights: [{directional: [0, 1, 0]}]"), backs);
    EXPECT_CONTAINS(saidOfLight("{directional: [0, 1, 0]}"), "the way that the light travels");
    EXPECT_CONTAINS(saidOfLight("{point: [0, 180, 0]}"), backs);
    // At the ceiling, through the open front from far away, and one that is yet to come
    EXPECT_EQ(saidOfLight("{spot: [0, 1, 0], direction: [0, 1, 0], outer_deg: 2}"), "");
    EXPECT_EQ(saidOfLight("{point: [0, 1, 1000]}, {directional: [0, 0, -1]}"), "");
    EXPECT_EQ(saidOfLight("{spot: [0, 1, 3], direction: [0, 0, 1], move: [0, 0, -1]}"), "");
}

TEST(ViewCheck, WarnsOfLightThatDoesNotComeToTheView) {
    // Inside of the taller box, while the lamp at the ceiling shines
    const std::string hidden = saidOf("builtin: cornell, lights: [{point: [-0.35, 0.6, -0.3]}]");
    EXPECT_CONTAINS(hidden, "x.yaml:2: scene.lights[0]: none of its light comes to what the camera sees");
    // Behind the taller box, where it lights the wall that the camera sees by that wall alone
    EXPECT_EQ(saidOf("builtin: cornell, lights: [{point: [-0.35, 0.4, -0.9]}]"), "");
    // The sun above the ceiling of a closed room, and one that shines into the open box
    EXPECT_CONTAINS(saidOf("builtin: white_room, environment: 0.1, lights: [{directional: [0, -1, 0]}]"),
                    "scene.lights[0]: it lights the backs of surfaces alone");
    EXPECT_EQ(saidOf("builtin: cornell, lights: [{directional: [0, -0.5, -1]}]"), "");
}

TEST(ViewCheck, NamesWhatIsInTheWayOfASun) {
    // The floor of the open box below a dome, a sphere that encloses it
    const std::string dome = saidOf(
        "builtin: cornell, lights: [{directional: [0, -0.5, -1]}], add: [{builtin: furnace, transform: {scale: "
        "20}, material: {base_color: 0.5}}]");
    EXPECT_CONTAINS(dome, "scene.lights[0]: it lights the backs of surfaces alone");
    EXPECT_CONTAINS(dome, "; 'furnace' is in its way: 'scene.hide: [\"furnace\"]' takes it out of the scene");
}

TEST(ViewCheck, AStrayTriangleHidesNoSun) {
    for (const char* away : {"1e3", "1e5", "1e6"})
        EXPECT_EQ(saidOf(fmt::format("builtin: plane, add: [{{builtin: plane, transform: {{translate: "
                                     "[{0}, {0}, 0]}}}}], lights: [{{directional: [0, -1, 0]}}]",
                                     away)),
                  "");
}

TEST(ViewCheck, WarnsOfVoxelsOverMoreThanIsSeen) {
    const std::string stray = "builtin: cornell, add: [{builtin: plane, transform: {translate: [1000, 0, 0]}}]";
    const std::string graph = "[{pass: gbuffer}, {pass: voxelize}]";
    EXPECT_EQ(saidOf("builtin: cornell", 0, graph), "");
    EXPECT_EQ(saidOf(stray), "") << "nothing is voxelized";
    const std::string said = saidOf(stray, 0, graph);
    EXPECT_CONTAINS(said, "x.yaml:2: scene: it is 1.01e+03 m across");
    // What is proposed is a region of a config
    const std::string region = said.substr(said.find("region: {"));
    EXPECT_EQ(saidOf(stray + ", " + region, 0, graph), "");
    EXPECT_CONTAINS(refusalOf(stray + ", region: {min: [5, 5, 5], max: [6, 6, 6]}"), "none of the scene lies in it");
    EXPECT_CONTAINS(refusalOf(stray + ", region: {min: [1, 0, 0], max: [1, 1, 1]}"), "min must be less than max");
}

TEST(ViewCheck, WarnsOfViewsThatAreWhiteOrBlack) {
    const std::string lamp = "builtin: white_room, keep_file_lights: false, lights: [{point: [0, 0, 0], intensity: ";
    const std::string bright = saidOf(lamp + "80000}]");
    EXPECT_CONTAINS(bright, "x.yaml:2: scene.lights[0]: nearly all of the view is white: ");
    EXPECT_CONTAINS(bright, "1 is white at exposure_stops: 0; divide it by about ");
    const std::string dark = saidOf(lamp + "1e-7}]");
    EXPECT_CONTAINS(dark, "x.yaml:2: scene.lights[0]: nearly all of the view is black: ");
    EXPECT_CONTAINS(dark, "multiply it by about ");
    EXPECT_EQ(saidOf(lamp + "1}]"), "");

    // The exposure that it names shows the view
    const auto stopsIn = [](const std::string& said) {
        const std::string key = "{exposure_stops: ";
        return std::stoi(said.substr(said.find(key) + key.size()));
    };
    EXPECT_EQ(saidOf(lamp + "80000}]", stopsIn(bright)), "");
    EXPECT_EQ(saidOf(lamp + "1e-7}]", stopsIn(dark)), "");

    // A sky by its color in bytes; one of 1 is white, and no brighter
    const std::string sky = saidOf("builtin: cornell, environment: [135, 206, 235]");
    EXPECT_CONTAINS(sky, "x.yaml:2: scene.environment: nearly all of the view is white");
    EXPECT_CONTAINS(sky, "as a color of 0 to 255 it is [0.2423, 0.6172, 0.8308]");
    EXPECT_EQ(saidOf("builtin: cornell, environment: 1"), "");
    EXPECT_EQ(saidOf("builtin: furnace"), "");  // Of 2 everywhere
}

}  // namespace
}  // namespace voxray
