#include "experiment/scoring.h"

#include <gtest/gtest.h>

#include "config/yaml.h"
#include "experiment/scene_setup.h"

using namespace voxray;

TEST(Afterglow, CountsFramesInWhichALightThatIsOffIsSeen) {
    // A light of 4 over another one of 1 goes off in frame 2 and halves in each frame from there
    const std::vector<FrameMeans> means{{5, 5}, {5, 5}, {3, 1}, {2, 1}, {1.05, 1}, {1.5, 1}, {0.9, 1}};
    std::vector<FrameScores> frames;
    for (uint32_t i = 0; i < means.size(); ++i) frames.push_back({i, {}});
    scoreAfterglow(means, 2, "indirect_", frames);
    EXPECT_FALSE(frames[1].scores.contains("indirect_afterglow"));
    const double left[] = {0.5, 0.25, 0.0125, 0.125, -0.025}, lit[] = {1, 2, 2, 3, 3};
    for (size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(frames[i + 2].scores.at("indirect_afterglow"), left[i], 1e-12);
        EXPECT_EQ(frames[i + 2].scores.at("indirect_frames_lit"), lit[i]);
    }
}

TEST(Afterglow, IsNotTakenWhereNoLightIsLost) {
    const std::vector<FrameMeans> means{{5, 5}, {5, 5}};
    std::vector<FrameScores> frames{{0, {}}, {1, {}}};
    scoreAfterglow(means, 1, "", frames);
    EXPECT_TRUE(frames[1].scores.empty());
}

TEST(Afterglow, ALightIsSwitchedOffInItsFrame) {
    const SceneSettings settings = readSceneSettings(
        parseYaml("{builtin: cornell, lights: [{point: [0, 1, 0], intensity: 5, off_at: 3}]}", "scene"));
    EXPECT_TRUE(changesInTime(settings));
    EXPECT_EQ(firstLightOff(settings), 3u);
    SceneLoader loader({});
    PreparedScene scene = loader.prepare(settings);
    const auto intensity = [&](int frame) {
        SceneLoader::goToFrame(scene, settings, frame);
        return scene.state.lights.back().intensity.x;
    };
    EXPECT_EQ(intensity(2), 5);
    EXPECT_EQ(intensity(3), 0);
    EXPECT_EQ(intensity(-4), 5);
}
