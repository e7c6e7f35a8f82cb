#include <gtest/gtest.h>

#include <cstring>

#include "scene/moving_spheres.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

/// Cornell with a ball that swings between the boxes.
std::shared_ptr<const Scene> swingingBall() {
    auto scene = std::make_shared<Scene>(*makeBuiltinScene("cornell", parseYaml("{lights: point}", "scene")));
    MovingSpheres spheres;
    spheres.radius = 0.2f;
    spheres.center = {0, 1.3f, 0.2f};
    spheres.swing = {0.6f, 0, 0};
    addMovingSpheres(*scene, spheres);
    return scene;
}

std::shared_ptr<SceneState> at(const std::shared_ptr<const Scene>& scene, double time) {
    return std::make_shared<SceneState>(evaluate(scene, time, Playback::Looping));
}

bool sameImage(const ImageF& a, const ImageF& b) {
    return std::memcmp(a.data.data(), b.data.data(), a.data.size() * sizeof(float)) == 0;
}

/// A chain that came to a time from another one is one that was made there, bit for bit.
void expectAsMadeThere(const std::string& inject, const std::string& layout) {
    const std::string graph = "[{pass: gbuffer}, {pass: voxelize, resolution: 16}, {pass: " + inject +
                              "}, {pass: filter_voxels, layout: " + layout +
                              "}, {pass: gather_cones}, {pass: direct_shadow_rays}, {pass: composite}]";
    const auto scene = swingingBall();
    Chain moving(at(scene, 0), graph, 24, 24, 1);
    ImageF before = moving.image("final");
    for (const double time : {0.7, 3.1}) {
        moving.goTo(time);
        const ImageF image = moving.image("final");
        EXPECT_TRUE(sameImage(image, Chain(at(scene, time), graph, 24, 24, 1).image("final")))
            << inject << ", " << layout << " at " << time;
        EXPECT_FALSE(sameImage(image, before));
        before = image;
    }
}

TEST(MovingScene, EveryLayoutIsAsMadeThere) {
    for (const char* layout : {"dense", "clipmap", "svo"}) expectAsMadeThere("inject_shadow_map", layout);
}

TEST(MovingScene, EveryInjectionIsAsMadeThere) {
    for (const char* inject : {"inject_light_rays, rays_per_light: 4096", "inject_camera_rays, rays: 4096",
                               "inject_voxel_rays", "inject_rsm"})
        expectAsMadeThere(inject, "dense");
}

TEST(MovingScene, PathTracerFollows) {
    const std::string graph = "[{pass: path_trace, spp: 4, bounces: 1}]";
    const auto scene = swingingBall();
    Chain moving(at(scene, 0), graph, 24, 24, 1);
    moving.goTo(0.7);
    EXPECT_TRUE(sameImage(moving.image("final"), Chain(at(scene, 0.7), graph, 24, 24, 1).image("final")));
}

TEST(MovingScene, LightsMoveWithoutSurfaces) {
    const std::string graph =
        "[{pass: gbuffer}, {pass: voxelize, resolution: 16}, {pass: inject_shadow_map}, {pass: "
        "filter_voxels, layout: svo}, "
        "{pass: gather_cones}, {pass: direct_shadow_rays}, {pass: composite}]";
    const auto scene = makeBuiltinScene("cornell", parseYaml("{lights: point}", "scene"));
    const auto lightAt = [](SceneState& state) {
        state.lights[0].position += glm::vec3(0.3f, -0.4f, 0);
        return std::vector<Box>();
    };
    Chain moved(at(scene, 0), graph, 24, 24, 1);
    moved.update(lightAt);
    const auto there = at(scene, 0);
    lightAt(*there);
    EXPECT_TRUE(sameImage(moved.image("final"), Chain(there, graph, 24, 24, 1).image("final")));
}

}  // namespace
}  // namespace voxray::test
