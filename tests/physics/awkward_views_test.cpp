// Lights and cameras where they are awkward, with every injection strategy, against the path tracer.
#include <gtest/gtest.h>

#include "tests/gpu/chain.h"
#include "tests/support/injections.h"

namespace voxray::test {
namespace {

// One sample in the center of each of 24 x 24 pixels is off by 3 % of the mean: it lies on the room's edges.
std::string graphOf(const Injection& injection) {
    return graphYaml({"gbuffer, samples_per_pixel_edge: 4", "voxelize", "place_surfels, points_per_voxel: 8",
                      "link_surfels", "trace_gather_rays, rays_per_block: 32", injection.withBounces(3),
                      "gather_rays"});
}

TEST(AwkwardViews, LightOutsideTheGridShinesIntoIt) {
    // Next to the camera, 2 m before the box's open side.
    SceneState state = *builtin("cornell", "{lights: point}");
    state.lights.at(0).position = state.cameras.at(0).position + glm::vec3(0.5f, 0, 0);
    const double expected = meanIndirect(state, graphYaml({"path_trace, spp: 256, bounces: 4"}), 24, 24);
    ASSERT_GT(expected, 0);
    for (const Injection& injection : kInjections)
        EXPECT_NEAR(meanIndirect(state, graphOf(injection), 24, 24) / expected, 1, 0.03) << injection.pass;
}

TEST(AwkwardViews, CameraInsideABoxSeesNoLight) {
    // Within the tall box, that no light enters. Voxels along its edges hold its inner and outer faces of one
    // direction and leak between them: at 32³ up to 2 % of what the lit room shows.
    SceneState state = *builtin("cornell", "{lights: point}");
    const double lit = meanIndirect(state, graphYaml({"path_trace, spp: 16, bounces: 4"}), 24, 24);
    state.cameras.at(0).position = {-0.326f, 0.6f, -0.257f};
    for (const Injection& injection : kInjections) {
        const double leak = meanIndirect(state, graphOf(injection), 24, 24) / lit;
        std::printf("%s: %.2g of the lit room\n", injection.pass.c_str(), leak);
        EXPECT_LT(leak, 0.02) << injection.pass;
    }
}

TEST(AwkwardViews, CameraInAVoxelizedWall) {
    // In the back wall's plane, looking out of it: what the voxels there hold does not come between.
    SceneState state = *builtin("cornell", "{lights: point}");
    Camera& camera = state.cameras.at(0);
    camera.position.z = -0.999f;
    camera.forward = {0, 0, 1};
    const double expected = meanIndirect(state, graphYaml({"path_trace, spp: 256, bounces: 4"}), 24, 24);
    for (const Injection& injection : kInjections)
        EXPECT_NEAR(meanIndirect(state, graphOf(injection), 24, 24) / expected, 1, 0.03) << injection.pass;
}

}  // namespace
}  // namespace voxray::test
