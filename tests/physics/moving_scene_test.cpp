#include <gtest/gtest.h>

#include <cstring>

#include "scene/moving_spheres.h"
#include "tests/gpu/chain.h"
#include "tests/support/radiance_layouts.h"

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

std::string graphOf(const std::string& inject, const std::string& filter) {
    return graphYaml({"gbuffer", "voxelize, resolution: 8", "place_surfels, points_per_voxel: 1",
                      "link_surfels, rays_per_surfel: 4", inject, "filter_voxels, " + filter, "gather_cones",
                      "direct_shadow_rays", "composite"});
}

/// A chain that came to a time from another one is one that was made there, bit for bit.
void expectAsMadeThere(const std::string& graph) {
    const auto scene = swingingBall();
    Chain moving(at(scene, 0), graph, 16, 16, 1);
    ImageF before = moving.image("final");
    for (const double time : {0.7, 3.1}) {
        moving.goTo(time);
        const ImageF image = moving.image("final");
        EXPECT_TRUE(sameImage(image, Chain(at(scene, time), graph, 16, 16, 1).image("final")))
            << graph << " at " << time;
        EXPECT_FALSE(sameImage(image, before));
        before = image;
    }
}

TEST(MovingScene, EveryLayoutIsAsMadeThere) {
    for (const TestedLayout& layout : kRadianceLayouts)
        expectAsMadeThere(graphOf(
            "inject_voxel_rays, direct: shadow_maps, shadow_resolution: 64, paths_per_point: 2, bounces: 1",
            "layout: " + layout.filter));
}

TEST(MovingScene, EveryInjectionIsAsMadeThere) {
    for (const char* inject :
         {"inject_light_rays, rays_per_light: 1024", "inject_voxel_rays, paths_per_point: 2, bounces: 1",
          "inject_radiosity, bounces: 2", "inject_rsm, rsm_resolution: 64"})
        expectAsMadeThere(graphOf(inject, "layout: dense"));
}

TEST(MovingScene, PathTracerFollows) {
    const std::string graph = graphYaml({"path_trace, spp: 4, bounces: 1"});
    const auto scene = swingingBall();
    Chain moving(at(scene, 0), graph, 16, 16, 1);
    moving.goTo(0.7);
    EXPECT_TRUE(sameImage(moving.image("final"), Chain(at(scene, 0.7), graph, 16, 16, 1).image("final")));
}

TEST(MovingScene, LightsMoveWithoutSurfaces) {
    const auto scene = makeBuiltinScene("cornell", parseYaml("{lights: point}", "scene"));
    const auto lightAt = [](SceneState& state) {
        state.lights[0].position += glm::vec3(0.3f, -0.4f, 0);
        return std::vector<Box>();
    };
    const auto there = at(scene, 0);
    lightAt(*there);
    for (const TestedLayout& layout : kRadianceLayouts) {
        const std::string graph = graphOf(
            "inject_voxel_rays, direct: shadow_maps, shadow_resolution: 64, paths_per_point: 2, bounces: 1",
            "layout: " + layout.filter);
        Chain moved(at(scene, 0), graph, 16, 16, 1);
        moved.update(lightAt);
        EXPECT_TRUE(sameImage(moved.image("final"), Chain(there, graph, 16, 16, 1).image("final")))
            << layout.filter;
    }
}

}  // namespace
}  // namespace voxray::test
