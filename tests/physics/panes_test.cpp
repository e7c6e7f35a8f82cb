// Light that passes coloured panes, against the twin whose lights have that colour and which has no panes.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/panes.h"
#include "scene/region_split.h"
#include "scene/shapes.h"
#include "tests/gpu/chain.h"
#include "tests/support/injections.h"

namespace voxray::test {
namespace {

constexpr glm::vec3 kGlass(0.8f, 0.5f, 0.25f);

enum class Shines { Sun, Sky, Lamp };

/// A room of 2 m without a ceiling, over which panes lie, and light above them.
std::shared_ptr<SceneState> glazedRoom(Shines shines, int panes, const glm::vec3& light) {
    SceneBuilder b("glazed room");
    const uint32_t wall = b.lambert("wall", glm::vec3(0.5f));
    b.room(glm::vec3(-1), glm::vec3(1), {wall, wall, wall, SceneBuilder::none, wall, wall});
    if (shines == Shines::Lamp)
        b.quad("lamp", {-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, b.lambert("lamp", {}, 4.0f * light));
    if (shines == Shines::Sun) b.directionalLight({0.3f, -1, 0.1f}, 3.0f * light);
    Material glass;
    glass.name = "glass";
    glass.metallic = 0;
    glass.transmission = 1;
    glass.baseColor = glm::vec4(kGlass, 1);
    const uint32_t material = b.material(glass);
    for (int i = 0; i < panes; ++i) b.quad("pane", {-3, 1.1f + 0.1f * float(i), -3}, {0, 0, 6}, {6, 0, 0}, material);
    b.camera({0, 0.5f, 0.9f}, {0, -1, -0.3f}, 70);
    if (shines == Shines::Sky) b.scene().environment.radiance = light;
    return std::make_shared<SceneState>(evaluateWithPanes(b.finish(), 0.0));
}

void expectTwinsImage(Shines shines, int panes, const std::vector<std::string>& passes, const std::string& image,
                      double tolerance) {
    const glm::vec3 color = panes == 1 ? kGlass : kGlass * kGlass;
    Chain glazed(glazedRoom(shines, panes, glm::vec3(1)), graphYaml(passes), 24, 24);
    Chain twin(glazedRoom(shines, 0, color), graphYaml(passes), 24, 24);
    const ImageF a = glazed.image(image), b = twin.image(image);
    for (size_t channel = 0; channel < 3; ++channel) {
        double sumA = 0, sumB = 0;
        for (size_t i = channel; i < a.data.size(); i += 3) {
            sumA += double(a.data[i]);
            sumB += double(b.data[i]);
        }
        ASSERT_GT(sumB, 0);
        EXPECT_NEAR(sumA / sumB, 1, tolerance) << passes.back() << ", channel " << channel;
    }
}

TEST(Panes, AreMetByNoRayAndInNoVoxel) {
    const auto state = glazedRoom(Shines::Sun, 2, glm::vec3(1));
    const auto twin = glazedRoom(Shines::Sun, 0, glm::vec3(1));
    EXPECT_EQ(state->geometry.positions, twin->geometry.positions);
    ASSERT_TRUE(state->panes);
    EXPECT_EQ(state->panes->geometry.triangles.size(), 4u);
    EXPECT_TRUE(dimsLight(*state));
    EXPECT_FALSE(dimsLight(*twin));
}

TEST(Panes, StayWhereARegionIsCut) {
    const auto state = glazedRoom(Shines::Sun, 1, glm::vec3(1));
    const SceneState cut = splitAtRegion(*state, {glm::vec3(-1), glm::vec3(0.5f)}, 0);
    EXPECT_EQ(cut.panes, state->panes);
}

TEST(Panes, ColorTheReference) {
    for (const int panes : {1, 2})
        for (const Shines shines : {Shines::Sun, Shines::Sky, Shines::Lamp})
            expectTwinsImage(shines, panes, {"path_trace, spp: 64, bounces: 2"}, "final", 0.01);
}

TEST(Panes, ColorShadowRays) {
    for (const int panes : {1, 2})
        for (const Shines shines : {Shines::Sun, Shines::Sky, Shines::Lamp})
            expectTwinsImage(shines, panes, {"gbuffer", "direct_shadow_rays, light_samples: 16"}, "direct", 0.001);
}

TEST(Panes, ColorInjectionsAndVirtualLights) {
    for (const Injection& injection : kInjections) {
        if (injection.pass.find("shadow_maps") != std::string::npos) continue;  // Shadow maps see no colour.
        expectTwinsImage(Shines::Sun, 2,
                         {"gbuffer", "voxelize, resolution: 16", "place_surfels, points_per_voxel: 4", "link_surfels",
                          "trace_gather_rays, rays_per_block: 16", injection.withBounces(1), "gather_rays"},
                         "indirect", 0.01);
    }
    expectTwinsImage(Shines::Sun, 1,
                     {"gbuffer", "sample_vpls, vpls_per_bounce: 2048", "gather_vpls, visibility: exact"}, "indirect",
                     0.01);
}

}  // namespace
}  // namespace voxray::test
