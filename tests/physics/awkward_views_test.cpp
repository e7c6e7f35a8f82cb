// Lights and cameras where they are awkward, with every injection strategy, against the path tracer.
#include <gtest/gtest.h>

#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

const std::vector<std::string> kStrategies = {"inject_light_rays, rays_per_light: 65536",
                                              "inject_rsm, resolution: 128",
                                              "inject_voxel_rays, rays: 2",
                                              "inject_gather_hits",
                                              "inject_camera_rays, rays: 65536",
                                              "inject_shadow_map, resolution: 256, rays: 2"};

std::string graphOf(const std::string& strategy, int bounces = 3) {
    return "[{pass: gbuffer}, {pass: voxelize, resolution: 32}, {pass: place_surfels, points: 8}, {pass: "
           "trace_gather_rays, rays: 32}, {pass: " +
           strategy + ", bounces: " + std::to_string(bounces) + "}, {pass: gather_rays, filter: 0}]";
}

/// The Cornell box, lit by a point light of 1 W/sr.
SceneState cornell() {
    return evaluate(makeBuiltinScene("cornell", parseYaml("{lights: point}", "scene")), 0.0);
}

double meanIndirect(const SceneState& state, const std::string& graph) {
    return mean(Chain(std::make_shared<SceneState>(state), graph, 24, 24, 1).image("indirect"));
}

TEST(AwkwardViews, LightOutsideTheGridShinesIntoIt) {
    // Beside the camera, 2 m before the box's open side.
    SceneState state = cornell();
    state.lights.at(0).position = state.cameras.at(0).position + glm::vec3(0.5f, 0, 0);
    const double expected = meanIndirect(state, "[{pass: path_trace, spp: 256, bounces: 4}]");
    ASSERT_GT(expected, 0);
    for (const std::string& strategy : kStrategies)
        EXPECT_NEAR(meanIndirect(state, graphOf(strategy)) / expected, 1, 0.04) << strategy;
}

TEST(AwkwardViews, CameraInsideABoxSeesNoLight) {
    // Within the tall box, that no light enters: darkness, or the clear error that nothing is lit. Along its
    // edges voxels hold sides within and without that face the same way, and leak between them: at 32³ up to
    // 2 % of what the lit room shows.
    SceneState state = cornell();
    const double lit = meanIndirect(state, "[{pass: path_trace, spp: 16, bounces: 4}]");
    state.cameras.at(0).position = {-0.326f, 0.6f, -0.257f};
    for (const std::string& strategy : kStrategies) {
        try {
            EXPECT_LT(meanIndirect(state, graphOf(strategy)), 0.02 * lit) << strategy;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("light"), std::string::npos) << error.what();
        }
    }
}

TEST(AwkwardViews, CameraInTheMiddleOfAVoxelizedWall) {
    // In the back wall's plane, looking out of it: what the voxels there hold does not come between.
    SceneState state = cornell();
    Camera& camera = state.cameras.at(0);
    camera.position.z = -0.999f;
    camera.forward = {0, 0, 1};
    const double expected = meanIndirect(state, "[{pass: path_trace, spp: 256, bounces: 4}]");
    for (const std::string& strategy : kStrategies)
        EXPECT_NEAR(meanIndirect(state, graphOf(strategy)) / expected, 1, 0.04) << strategy;
}

}  // namespace
}  // namespace voxray::test
