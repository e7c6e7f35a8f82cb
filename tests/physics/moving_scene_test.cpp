#include <gtest/gtest.h>

#include "tests/gpu/chain.h"
#include "tests/support/radiance_layouts.h"

namespace voxray::test {
namespace {

/// Cornell with a ball that swings between the boxes.
std::shared_ptr<const Scene> swingingBall() {
    return cornellWithBall({.radius = 0.2f, .center = {0, 1.3f, 0.2f}, .swing = {0.6f, 0, 0}});
}

std::string graphOf(const std::string& inject, const std::string& filter) {
    return graphYaml({"gbuffer", "voxelize, resolution: 8", "place_surfels, points_per_voxel: 1",
                      "link_surfels, rays_per_surfel: 4", inject, "filter_voxels, " + filter,
                      "gather_cones, visibility: voxels", "direct_shadow_rays", "composite"});
}

/// A chain that came to a time from another one is one that was made there, bit for bit.
void expectAsMadeThere(const std::string& graph) {
    const auto scene = swingingBall();
    const auto moving = chainAt(scene, 0, graph);
    ImageF before = moving->image("final");
    for (const double time : {0.7, 3.1}) {
        moving->goTo(time);
        const ImageF image = moving->image("final");
        EXPECT_TRUE(sameBits(image.data, chainAt(scene, time, graph)->image("final").data)) << graph << " at " << time;
        EXPECT_FALSE(sameBits(image.data, before.data));
        before = image;
    }
}

TEST(MovingScene, EveryLayoutIsAsMadeThere) {
    for (const TestedLayout& layout : kRadianceLayouts)
        expectAsMadeThere(
            graphOf("inject_voxel_rays, direct: shadow_maps, shadow_resolution: 64, paths_per_point: 2, bounces: 1",
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
    const auto moving = chainAt(scene, 0, graph);
    moving->goTo(0.7);
    EXPECT_TRUE(sameBits(moving->image("final").data, chainAt(scene, 0.7, graph)->image("final").data));
}

TEST(MovingScene, PathTracerFollowsALampThatMoves) {
    // The ball shines, as the ceiling's lamp does, which stays: patches of both are numbered anew
    const std::string graph = graphYaml({"path_trace, spp: 4, bounces: 1"});
    const auto scene = builtinScene("cornell", "{lights: area}");
    addMovingSpheres(*scene, {.radius = 0.2f, .center = {0, 1.3f, 0.2f}, .swing = {0.6f, 0, 0}});
    scene->materials.back().emission = glm::vec3(2.0f);
    const auto moving = chainAt(scene, 0, graph);
    for (const double time : {0.7, 3.1}) {
        moving->goTo(time);
        EXPECT_TRUE(sameBits(moving->image("final").data, chainAt(scene, time, graph)->image("final").data)) << time;
    }
}

TEST(MovingScene, PathTracerFollowsLightsAlone) {
    const std::string graph = graphYaml({"path_trace, spp: 4, bounces: 1"});
    const auto scene = builtinScene("cornell", "{lights: point}");
    const auto there = evaluated(scene, 0, Playback::Looping);
    moveLight(*there);
    const auto moved = chainAt(scene, 0, graph);
    const ImageF before = moved->image("final");
    moved->update(moveLight);
    const ImageF image = moved->image("final");
    EXPECT_TRUE(sameBits(image.data, Chain(there, graph, 16, 16).image("final").data));
    EXPECT_FALSE(sameBits(image.data, before.data));
}

TEST(MovingScene, LightsMoveWithoutSurfaces) {
    const auto scene = builtinScene("cornell", "{lights: point}");
    const auto there = evaluated(scene, 0, Playback::Looping);
    moveLight(*there);
    for (const TestedLayout& layout : kRadianceLayouts) {
        const std::string graph =
            graphOf("inject_voxel_rays, direct: shadow_maps, shadow_resolution: 64, paths_per_point: 2, bounces: 1",
                    "layout: " + layout.filter);
        const auto moved = chainAt(scene, 0, graph);
        moved->update(moveLight);
        EXPECT_TRUE(sameBits(moved->image("final").data, Chain(there, graph, 16, 16).image("final").data))
            << layout.filter;
    }
}

}  // namespace
}  // namespace voxray::test
