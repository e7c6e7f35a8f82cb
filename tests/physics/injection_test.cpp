// Light injection and gathering against closed forms, and against the path tracer.
#include <gtest/gtest.h>

#include <cmath>

#include "image/metrics.h"
#include "passes/common/voxels/voxels.h"
#include "tests/physics/voxels_read.h"

namespace voxray::test {
namespace {

TEST(Injection, ClosedRoomCatchesAllLight) {
    // A point light of I W/sr in a closed room: 4 pi I arrives at its walls.
    Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                graphYaml({"voxelize, resolution: 24", "inject_light_rays, bounces: 0"}));
    EXPECT_NEAR(totalFlux(chain, irradiance(chain).direct) / (4 * kPi * 2), 1.0, 1e-4);
    EXPECT_EQ(totalFlux(chain, irradiance(chain).indirect), 0.0);
}

TEST(Injection, BouncesSumToTheGeometricSeries) {
    // Walls of albedo a reflect a of all that arrives: indirect flux = direct * (a + a² + ... + a^bounces).
    Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                graphYaml({"voxelize, resolution: 24", "inject_light_rays, rays_per_light: 262144, bounces: 3"}));
    const double expected = 4 * kPi * 2 * (0.5 + 0.25 + 0.125);
    EXPECT_NEAR(totalFlux(chain, irradiance(chain).indirect) / expected, 1.0, 0.01);
}

TEST(Injection, EmissiveFurnaceReachesItsClosedForm) {
    // Every surface emits e and reflects a: the irradiance is pi e / (1 - a) everywhere, of which pi e is
    // direct. Of so many rays the mean of all light is 0.998 of it over five seeds, with a standard deviation of 0.002.
    Chain chain("furnace", "{shape: box, albedo: 0.6, emission: 1}",
                graphYaml({"gbuffer", "voxelize, resolution: 16, samples_per_voxel_edge: 4",
                           "inject_light_rays, rays_per_light: 262144, bounces: 24", "gather_irradiance, radius: 2",
                           "gather_irradiance, id: direct, light: direct, radius: 2", "composite"}));
    EXPECT_NEAR(mean(chain.image("direct")), 0.6, 0.02 * 0.6);
    EXPECT_NEAR(mean(chain.image("final")), 1 / (1 - 0.6), 0.02 / (1 - 0.6));
}

TEST(Injection, SheetsInBordersCatchTheirLightInTheVoxelsThatHoldTheirArea) {
    // Rounding may put the points of a sheet into the voxels on either side of it, most where coordinates are
    // large. A sun of E = 3 W/m² falls straight onto seven sheets in seven borders, none behind another; two
    // specks make the grid. Panels that the sun sees edge-on occupy the voxels on both sides of each sheet.
    constexpr float kSun = 3;
    const glm::vec3 low(6.97f, -0.71f, -0.57f), high(9.17f, 0.93f, 0.69f);
    const gpu::VoxelGrid grid = makeVoxelGrid(low, high, 24);
    const float size = grid.voxelSize;
    SceneBuilder b("sheets");
    const uint32_t grey = b.lambert("grey", glm::vec3(0.5f));
    b.quad("speck", low, {0, 0, 0.003f}, {0, 0.003f, 0}, grey);
    b.quad("speck", high, {0, 0, -0.003f}, {0, -0.003f, 0}, grey);
    double caught = 0;
    for (int i = 0; i < 7; ++i) {
        const float x = grid.origin.x + size * float(3 * i + 2), y = grid.origin.y + size * (float(2 * i) + 1.1f);
        b.quad("sheet", {x, y, -0.31f}, {0, 0, 0.7f}, {0, 0.8f * size, 0}, grey);
        b.quad("panel", {x - size, y + 0.4f * size, -0.31f}, {0, 0, 0.7f}, {2 * size, 0, 0}, grey);
        caught += double(kSun * 0.7f * 0.8f * size);
    }
    b.directionalLight({1, 0, 0}, glm::vec3(kSun));
    b.camera({0, 0, 3}, {0, 0, 0}, 60);
    Chain chain(evaluated(b),
                graphYaml({"voxelize, resolution: 24", "inject_light_rays, rays_per_light: 1048576, bounces: 0"}), 16,
                16);

    const std::vector<float> flux = readFlux(chain, irradiance(chain).direct),
                             areas = readAreas(chain, irradiance(chain).area);
    double known = 0;
    for (size_t face = 0; face < areas.size(); ++face)
        if (areas[face] > 0.001f) known += double(flux[3 * face + 1]);
    EXPECT_NEAR(known / caught, 1.0, 0.01);
}

TEST(Injection, IsLinearInLight) {
    const std::string graph =
        graphYaml({"voxelize, resolution: 16", "inject_light_rays, rays_per_light: 16384, bounces: 2"});
    Chain one("white_room", "{intensity: 1}", graph), seven("white_room", "{intensity: 7}", graph);
    EXPECT_NEAR(totalFlux(seven, irradiance(seven).indirect) / totalFlux(one, irradiance(one).indirect), 7.0, 1e-4);
}

TEST(Injection, IsDeterministic) {
    const auto run = [] {
        Chain chain("cornell", "{lights: point}", graphYaml({"voxelize", "inject_light_rays"}));
        return chain.read<uint32_t>(irradiance(chain).indirect);
    };
    EXPECT_EQ(run(), run());
}

/// Direct light by shadow rays over that of the path tracer.
double directRatio(const std::string& scene, const std::string& parameters, int samples, uint32_t side) {
    const auto light = [&](const std::vector<std::string>& passes) {
        return mean(Chain(scene, parameters, graphYaml(passes), side, side).image("final"));
    };
    const std::string rays = fmt::format("direct_shadow_rays, light_samples: {}", samples);
    return light({"gbuffer", rays, "composite"}) /
           light({fmt::format("path_trace, spp: {}, bounces: 0", std::max(samples, 64))});
}

TEST(DirectShadowRays, MatchClosedFormsOnAPlane) {
    // Punctual lights are exact: the same image as the path tracer's, which has its own closed-form tests,
    // with rays through pixel centers instead of pixel means.
    for (const std::string light : {"point", "spot", "directional"})
        EXPECT_NEAR(directRatio("plane", "{light: " + light + "}", 1, 64), 1.0, 0.003) << light;
}

TEST(DirectShadowRays, AreaLightConvergesToTheReference) {
    // Pixel centers against pixel means: edges of the light weigh less the more pixels there are.
    EXPECT_NEAR(directRatio("quad_light", "{}", 64, 96), 1.0, 0.01);
}

TEST(DirectShadowRays, AWideLightHidesNothingOfItself) {
    // Rays that meet its plane at a slant end before it, too: most of what lies over the receiver is below 30
    // degrees.
    EXPECT_NEAR(directRatio("quad_light", "{light_size: 20, distance: 1}", 256, 64), 1.0, 0.01);
}

TEST(DirectShadowRays, EnvironmentConvergesToTheReference) {
    // Spheres and a floor under a white sky and nothing else.
    const auto scene = builtinScene("spheres", "{moving: false}");
    scene->lights.clear();
    scene->environment.radiance = glm::vec3(1.0f);
    const State state = evaluated(scene);
    Chain chain(state,
                graphYaml({"gbuffer, samples_per_pixel_edge: 2", "direct_shadow_rays, light_samples: 32", "composite"}),
                64, 48);
    Chain reference(state, graphYaml({"path_trace, spp: 128, bounces: 0"}), 64, 48);
    const ImageF image = chain.image("final"), truth = reference.image("final");
    EXPECT_NEAR(mean(image) / mean(truth), 1.0, 0.003);
    EXPECT_LT(nRmse(image, truth), 0.06);
    EXPECT_LT(mean(truth), 0.95);  // The surfaces are seen, not the sky alone.
}

TEST(VoxelLookup, OfDirectLightApproachesShadowRaysAsVoxelsShrink) {
    const auto error = [](uint32_t resolution) {
        Chain chain(
            "plane", "{light: point}",
            graphYaml({"gbuffer", "voxelize, samples_per_voxel_edge: 4, resolution: " + std::to_string(resolution),
                       "inject_light_rays, rays_per_light: 1048576, bounces: 0", "gather_irradiance, light: direct",
                       "composite"}));
        Chain exact("plane", "{light: point}", graphYaml({"gbuffer", "direct_shadow_rays", "composite"}));
        return meanDifference(chain.image("final"), exact.image("final"));
    };
    const double coarse = error(8), fine = error(64);
    EXPECT_LT(fine, coarse);
    EXPECT_LT(fine, 0.05);
}

TEST(VoxelLookup, SevenTapKeepsAConstantAndBlursAnEdge) {
    const auto direct = [](const std::string& scene, const std::string& parameters, const std::string& lookup) {
        Chain chain(scene, parameters,
                    graphYaml({"gbuffer", "voxelize, resolution: 16, samples_per_voxel_edge: 4",
                               "inject_light_rays, rays_per_light: 1048576, bounces: 0",
                               "gather_irradiance, light: direct, lookup: " + lookup}),
                    48, 48);
        return chain.image("direct");
    };

    // Emissive walls of albedo 0.6 and radiance 1 reflect 0.6 of it, but for noise where few samples fall.
    const std::string furnace = "{shape: box, albedo: 0.6, emission: 1}";
    for (const std::string lookup : {"trilinear", "seven_tap", "bilinear_face", "nearest_face"}) {
        double worst = 0;
        for (const float value : direct("furnace", furnace, lookup).data)
            worst = std::max(worst, std::abs(value - 0.6) / 0.6);
        EXPECT_LT(worst, 0.15) << lookup;
    }

    // Shadow edges: the steepest step between neighbors falls.
    const auto steepest = [](const ImageF& image) {
        float step = 0;
        for (uint32_t y = 0; y < image.height; ++y)
            for (uint32_t x = 1; x < image.width; ++x)
                step = std::max(step, std::abs(image.pixel(x, y)[1] - image.pixel(x - 1, y)[1]));
        return step;
    };
    const ImageF sharp = direct("plane", "{light: spot}", "trilinear");
    const ImageF blurred = direct("plane", "{light: spot}", "seven_tap");
    const ImageF faceted = direct("plane", "{light: spot}", "nearest_face");
    EXPECT_LT(steepest(blurred), 0.9f * steepest(sharp));
    EXPECT_NEAR(mean(blurred) / mean(sharp), 1.0, 0.05);
    EXPECT_GT(steepest(faceted), 1.5f * steepest(sharp));
    EXPECT_NEAR(mean(faceted) / mean(sharp), 1.0, 0.05);
}

TEST(Chain, CornellIndirectMatchesTheReference) {
    // 262144 paths: noise of half a percent of the mean
    Chain chain("cornell", "{lights: point}",
                graphYaml({"gbuffer, samples_per_pixel_edge: 2", "voxelize, resolution: 64",
                           "inject_light_rays, rays_per_light: 524288, bounces: 8", "gather_irradiance",
                           "direct_shadow_rays", "composite"}));
    Chain reference("cornell", "{lights: point}", graphYaml({"path_trace, spp: 256, bounces: 8"}));
    EXPECT_NEAR(mean(chain.image("final")) / mean(reference.image("final")), 1.0, 0.02);
    EXPECT_NEAR(mean(chain.image("indirect")) / mean(reference.image("indirect")), 1.0, 0.03);
}

}  // namespace
}  // namespace voxray::test
