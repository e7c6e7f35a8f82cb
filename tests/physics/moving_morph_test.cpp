// A ball that grows and travels by morph targets: images, voxels and motion vectors follow it.
#include <gtest/gtest.h>

#include "passes/common/view/gbuffer.h"
#include "passes/common/view/surface_motion.h"
#include "passes/common/voxels/voxels.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

constexpr glm::vec3 kCenter{-0.1f, 1.3f, 0.2f}, kWay{0.5f, 0, 0.1f};
constexpr float kRadius = 0.2f;

/// Weight of both targets at a time: from 0 to 1 in two seconds.
float weightAt(double seconds) {
    return float(seconds / 2);
}

std::shared_ptr<Scene> cornellWithSphere(const glm::vec3& center, float radius) {
    const auto scene = builtinScene("cornell", "{lights: point}");
    scene->instances.push_back({.mesh = uint32_t(scene->meshes.size())});
    scene->meshes.push_back(sphereMesh("ball", center, radius, 2, 0, false, true));
    return scene;
}

/// By the first target the ball's radius doubles, by the second it goes along kWay.
std::shared_ptr<const Scene> morphingBall() {
    const auto scene = cornellWithSphere(kCenter, kRadius);
    Mesh& mesh = scene->meshes.back();
    mesh.morph.targets.resize(2);
    for (const glm::vec3& p : mesh.positions) {
        mesh.morph.targets[0].positions.push_back(p - kCenter);
        mesh.morph.targets[1].positions.push_back(kWay);
    }
    scene->morphs = {{.targetCount = 2, .timesSeconds = {0, 2}, .values = {0, 0, 1, 1}}};
    scene->instances.back().morph = 0;
    return scene;
}

std::string lightGraph() {
    return graphYaml({"gbuffer", "voxelize, resolution: 16", "place_surfels, points_per_voxel: 1",
                      "link_surfels, rays_per_surfel: 4", "inject_voxel_rays, paths_per_point: 2, bounces: 1",
                      "filter_voxels, layout: dense", "gather_cones, visibility: voxels", "direct_shadow_rays",
                      "composite"});
}

TEST(MovingMorph, EveryPassIsAsMadeThere) {
    const auto moving = chainAt(morphingBall(), 0, lightGraph());
    ImageF before = moving->image("final");
    std::vector<uint32_t> voxelsBefore = moving->read<uint32_t>(moving->get<SurfaceVoxels>("voxels").occupancy);
    for (const double time : {0.7, 1.9}) {
        moving->goTo(time);
        const auto made = chainAt(morphingBall(), time, lightGraph());
        const ImageF image = moving->image("final");
        const auto voxels = moving->read<uint32_t>(moving->get<SurfaceVoxels>("voxels").occupancy);
        EXPECT_TRUE(sameBits(image.data, made->image("final").data)) << time;
        EXPECT_TRUE(sameBits(voxels, made->read<uint32_t>(made->get<SurfaceVoxels>("voxels").occupancy))) << time;
        EXPECT_FALSE(sameBits(image.data, before.data)) << time;
        EXPECT_FALSE(sameBits(voxels, voxelsBefore)) << time;
        before = image;
        voxelsBefore = voxels;
    }
}

TEST(MovingMorph, SumsOfLightAreInUnitsOfALampThatGrows) {
    const auto scene = std::make_shared<Scene>(*morphingBall());
    scene->meshes.back().material = uint32_t(scene->materials.size());
    scene->materials.emplace_back().emission = glm::vec3(5);
    for (const std::string inject : {"inject_camera_rays, rays_per_image: 1024, bounces: 1",
                                     "inject_voxel_rays, paths_per_point: 2, bounces: 1"}) {
        const std::string graph =
            graphYaml({"gbuffer", "voxelize, resolution: 16", "place_surfels, points_per_voxel: 1", inject,
                       "gather_irradiance", "direct_shadow_rays", "composite"});
        const auto moving = chainAt(scene, 0, graph);
        moving->goTo(1.9);
        EXPECT_TRUE(sameBits(moving->image("final").data, chainAt(scene, 1.9, graph)->image("final").data)) << inject;
    }
}

/// Mean difference of two images over the mean of the second.
double differenceOf(const ImageF& a, const ImageF& b) {
    double sum = 0;
    for (size_t i = 0; i < a.data.size(); ++i) sum += std::abs(double(a.data[i]) - double(b.data[i]));
    return sum / double(a.data.size()) / mean(b);
}

TEST(MovingMorph, ImageIsThatOfTheBallThatItBecomes) {
    const std::string graph = graphYaml({"path_trace, spp: 64, bounces: 1"});
    const auto moving = chainAt(morphingBall(), 0, graph);
    const ImageF before = moving->image("final");
    moving->goTo(1.9);
    const float w = weightAt(1.9);
    const auto ball = cornellWithSphere(kCenter + w * kWay, (1 + w) * kRadius);
    const ImageF expected = chainAt(ball, 0, graph)->image("final");
    // The same triangles but for rounding, and the same random numbers
    EXPECT_LT(differenceOf(moving->image("final"), expected), 1e-3);
    EXPECT_GT(differenceOf(before, expected), 0.02);
}

TEST(MovingMorph, MotionVectorsFollowItsPoints) {
    const auto moving =
        chainAt(morphingBall(), 0.5,
                graphYaml({"gbuffer", "voxelize, resolution: 8", "inject_light_rays, rays_per_light: 1024",
                           "trace_gather_rays, rays_per_block: 4", "gather_rays", "accumulate", "filter_irradiance"}));
    moving->goTo(1.9);
    const auto positions = moving->readImage<glm::vec4>(moving->get<GBuffer>("gbuffer").position);
    const auto previous = moving->readImage<glm::vec4>(moving->get<SurfaceMotion>("motion").previous);
    const float before = weightAt(0.5), now = weightAt(1.9);
    const glm::vec3 center = kCenter + now * kWay;
    size_t onBall = 0;
    for (size_t i = 0; i < positions.size(); ++i) {
        if (previous[i].w == 0) continue;
        const glm::vec3 p(positions[i]), was(previous[i]);
        const float distance = glm::distance(p, center);
        if (std::abs(distance - (1 + now) * kRadius) > 0.02f) continue;
        ++onBall;
        const glm::vec3 expected = kCenter + before * kWay + (p - center) * (1 + before) / (1 + now);
        EXPECT_LT(glm::distance(was, expected), 1e-3f) << i;
    }
    EXPECT_GT(onBall, 12u);
}

}  // namespace
}  // namespace voxray::test
