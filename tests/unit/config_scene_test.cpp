#include <gtest/gtest.h>

#include "config/sweep.h"
#include "tests/support/errors.h"

using namespace voxray;

namespace {

std::string withScene(const std::string& lines) {
    return "name: demo\nscene:\n  builtin: cornell\n  lights: point\n" + lines + "graph: [{pass: a}]\n";
}

SceneSettings read(const std::string& lines) {
    return parseExperiment(withScene(lines), "demo.yaml").setup.scene;
}

void expectError(const std::string& lines, std::initializer_list<const char*> parts) {
    const std::string message = errorOf<UsageError>([&] { parseExperiment(withScene(lines), "demo.yaml"); });
    for (const char* part : parts) EXPECT_CONTAINS(message, part);
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

}  // namespace

TEST(ComposedScene, AdditionsAreRead) {
    const SceneSettings scene = read(
        "  add:\n"
        "    - {file: models/dragon.glb, transform: {translate: [1, 2, 3], rotate_deg: [0, 90, 0], scale: "
        "2}}\n"
        "    - {builtin: mirror_row, count: 3, material: {base_color: [0.5, 0.25, 0.125], metallic: 1}}\n"
        "    - {builtin: cornell, lights: spot}\n");
    ASSERT_EQ(scene.additions.size(), 3u);
    EXPECT_EQ(scene.additions[0].source.file, "models/dragon.glb");
    EXPECT_EQ(scene.additions[0].source.name(), "dragon");
    EXPECT_EQ(scene.additions[0].placement.translate, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.additions[0].placement.rotateDegrees, glm::vec3(0, 90, 0));
    EXPECT_EQ(scene.additions[0].placement.scale, glm::vec3(2.0f));
    EXPECT_FALSE(scene.additions[0].material);
    EXPECT_EQ(scene.additions[1].source.builtinParameters.text(), "{count: 3}");
    ASSERT_TRUE(scene.additions[1].material);
    EXPECT_EQ(scene.additions[1].material->baseColor, glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(scene.additions[1].material->metallic, 1);
    EXPECT_EQ(scene.additions[2].source.builtinParameters.text(), "{lights: spot}");
    EXPECT_EQ(scene.source.builtinParameters.text(), "{lights: point}");
    EXPECT_TRUE(read("  add:\n").additions.empty());
}

TEST(ComposedScene, TheScenesOwnTransformIsRead) {
    const SceneSettings scene = read("  transform: {rotate_deg: [17, 0, 0], scale: 0.5}\n");
    ASSERT_TRUE(scene.placement);
    EXPECT_EQ(scene.placement->rotateDegrees, glm::vec3(17, 0, 0));
    EXPECT_EQ(scene.placement->scale, glm::vec3(0.5f));
    EXPECT_EQ(scene.source.builtinParameters.text(), "{lights: point}");
    EXPECT_FALSE(read("  transform: null\n").placement);
    EXPECT_FALSE(read("").placement);
    expectError("  transform: {scale: 0}\n", {"demo.yaml:5: ", "scene.transform.scale: 0 leaves nothing"});
    expectError("  transform: {rotate: [17, 0, 0]}\n", {"demo.yaml:5: ", "'rotate'"});
}

TEST(ComposedScene, OverridesHoldWhatIsGivenAlone) {
    const SceneSettings scene = read("  override:\n    grey: {roughness: 0.5, emission: 3}\n    red: {metallic: 1}\n");
    ASSERT_EQ(scene.overrides.size(), 2u);
    EXPECT_EQ(scene.overrides[0].material, "grey");
    EXPECT_EQ(scene.overrides[0].change.keys, (std::vector<std::string>{"roughness", "emission"}));
    EXPECT_EQ(scene.overrides[0].change.settings.emission, glm::vec3(3.0f));
    EXPECT_EQ(scene.overrides[1].where.line, 7);
}

TEST(ComposedScene, ErrorsNamePlaceAndNearestWord) {
    expectError("  add: {file: a.glb}\n", {"demo.yaml:5: ", "scene.add: expected a list"});
    expectError("  add: [dragon.glb]\n", {"demo.yaml:5: ", "scene.add[0]: expected a map"});
    expectError("  add: [{file: a.glb}, {transform: {scale: 2}}]\n", {"demo.yaml:5: ", "'file'"});
    expectError("  add: [{file: a.glb, builtin: plane}]\n", {"'file'"});
    expectError("  add:\n    - file: a.glb\n      transfrom: {scale: 2}\n", {"demo.yaml:7: ", "'transform'"});
    expectError("  add: [{file: a.glb, transform: {rotate: 3}}]\n", {"demo.yaml:5: ", "'rotate'"});
    expectError("  add: [{file: a.glb, transform: {scale: [1, 0, 1]}}]\n",
                {"demo.yaml:5: ", "scene.add[0].transform.scale: 0 leaves nothing"});
    expectError("  add: [{file: a.glb, material: {roughnes: 0}}]\n", {"demo.yaml:5: ", "'roughness'"});
    expectError("  add: [{file: a.glb, material: {metallic: 2}}]\n", {"demo.yaml:5: ", "out of range [0, 1]"});
    expectError("  override: [grey]\n", {"demo.yaml:5: ", "scene.override: expected a map"});
    expectError("  override: {grey: {}}\n", {"demo.yaml:5: ", "scene.override.grey: expected settings"});
    expectError("  override: {grey: {base_colour: 1}}\n", {"demo.yaml:5: ", "'base_color'"});
}

TEST(ComposedScene, SweepsCompose) {
    const std::vector<SweepPoint> variants = expandSweep(
        parseExperiment(withScene("") +
                            "sweep:\n"
                            "  scene.add: [[], [{file: dragon.glb}], [{file: dragon.glb}, {builtin: plane}]]\n"
                            "  scene.override: [{grey: {roughness: 0}}, {grey: {roughness: 1}}]\n",
                        "demo.yaml"),
        {});
    ASSERT_EQ(variants.size(), 6u);
    EXPECT_TRUE(variants[0].setup.scene.additions.empty());
    EXPECT_EQ(variants[4].setup.scene.additions.size(), 2u);
    EXPECT_EQ(variants[5].setup.scene.overrides[0].change.settings.roughness, 1);
    EXPECT_EQ(variants[0].name, "add none, override {grey: {roughness: 0}}");
    EXPECT_EQ(variants[2].id, "add-dragon.glb-override-grey-roughness-0");
    EXPECT_EQ(variants[4].values[0], "dragon.glb + plane");
}
