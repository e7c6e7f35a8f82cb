// Direct light by shadow maps, against closed forms and against shadow rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "passes/common/voxels/voxels.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

constexpr double kPi = std::numbers::pi;
const std::string kMaps = "inject_voxel_rays, direct: shadow_maps";

std::string injectGraph(const std::string& inject, const std::string& resolution = "24") {
    return graphYaml({"voxelize, resolution: " + resolution, "place_surfels, points_per_voxel: 16", inject});
}

/// Flux of each face, W, green channel.
std::vector<double> directFlux(Chain& chain) {
    const std::vector<float> values =
        readFlux(chain, chain.graph().resource<VoxelIrradiance>("irradiance")->direct);
    std::vector<double> flux(values.size() / 3);
    for (size_t i = 0; i < flux.size(); ++i) flux[i] = values[3 * i + 1];
    return flux;
}

double sum(const std::vector<double>& values) {
    double total = 0;
    for (const double value : values) total += value;
    return total;
}

/// Mean difference of two fields over the mean of the second.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double total = 0;
    for (size_t i = 0; i < a.size(); ++i) total += std::abs(a[i] - b[i]);
    return total / sum(b);
}

std::shared_ptr<SceneState> roomWithSpot(double coneDegrees) {
    SceneState state = evaluate(makeBuiltinScene("white_room", parseYaml("{}", "scene")), 0.0);
    Light& light = state.lights.at(0);
    light.type = LightType::Spot;
    light.direction = glm::normalize(glm::vec3(1, 2, 0.5f));
    light.outerConeAngle = float(coneDegrees * kPi / 180);
    light.innerConeAngle = light.outerConeAngle - 0.01f;
    return std::make_shared<SceneState>(state);
}

TEST(ShadowMap, ClosedRoomCatchesAllLight) {
    // A point light of 2 W/sr in a closed room: 8 pi W arrive, and the albedo's part of that again with each
    // bounce.
    Chain chain("white_room", "{albedo: 0.5, intensity: 2}",
                injectGraph(kMaps + ", paths_per_point: 4, bounces: 2"));
    EXPECT_NEAR(sum(directFlux(chain)) / (8 * kPi), 1.0, 0.01);
    const auto* irradiance = chain.graph().resource<VoxelIrradiance>("irradiance");
    double indirect = 0;
    for (const float watts : readFlux(chain, irradiance->indirect)) indirect += watts / 3;
    EXPECT_NEAR(indirect / (8 * kPi * 0.75), 1.0, 0.02);
}

TEST(ShadowMap, SpotsTakeOneMapOrTheCube) {
    // A uniform cone: 2 pi (1 - cos) I, narrower and wider than a side of the cube.
    for (const double degrees : {30.0, 80.0}) {
        Chain chain(roomWithSpot(degrees), injectGraph(kMaps + ", bounces: 0"), 8, 8, 1);
        const double center = degrees * kPi / 180 - 0.005;
        EXPECT_NEAR(sum(directFlux(chain)) / (2 * kPi * (1 - std::cos(center))), 1.0, 0.01) << degrees;
    }
}

TEST(ShadowMap, FlatSurfacesDoNotShadeThemselves) {
    // 1 m below a point light: the mean of 1 / d³ over each voxel's part of the plane, which the light meets
    // at up to 82°, with texels of up to half a metre.
    for (const std::string resolution : {"64", "1024"}) {
        Chain chain("plane", "{}",
                    graphYaml({"voxelize, resolution: 24", "place_surfels, points_per_voxel: 256",
                               kMaps + ", bounces: 0, shadow_resolution: " + resolution}));
        const auto& voxels = *chain.graph().resource<SurfaceVoxels>("voxels");
        const std::vector<float> area =
            readAreas(chain, chain.graph().resource<VoxelIrradiance>("irradiance")->area);
        const std::vector<double> flux = directFlux(chain);
        ASSERT_EQ(voxels.voxelCount, 24u * 24u);
        // Voxels are numbered by z, then x; direction 2 faces up.
        const double size = voxels.grid.voxelSize;
        double worst = 0;
        for (int z = 0; z < 24; ++z)
            for (int x = 0; x < 24; ++x) {
                constexpr int kParts = 8;
                double expected = 0;
                int parts = 0;
                for (int k = 0; k < kParts * kParts; ++k) {
                    const double px = (x - 12 + (k % kParts + 0.5) / kParts) * size;
                    const double pz = (z - 12 + (double(k / kParts) + 0.5) / kParts) * size;
                    if (std::max(std::abs(px), std::abs(pz)) > 5) continue;
                    expected += std::pow(1 + px * px + pz * pz, -1.5);
                    ++parts;
                }
                const size_t face = size_t(z * 24 + x) * 6 + 2;
                const double irradiance = flux[face] / (area[face] * size * size);
                worst = std::max(worst, std::abs(irradiance / (expected / parts) - 1));
            }
        EXPECT_LT(worst, 0.02) << resolution;
    }
}

TEST(ShadowMap, AgreesWithShadowRays) {
    const auto flux = [](const std::string& inject, const std::string& scene, const std::string& parameters) {
        Chain chain(scene, parameters, injectGraph(inject + ", bounces: 0"));
        return directFlux(chain);
    };
    for (const auto& [scene, parameters] :
         {std::pair{"cornell", "{lights: point}"}, std::pair{"spheres", "{moving: false}"},
          std::pair{"plane", "{light: directional}"}, std::pair{"thin_wall", "{}"}}) {
        const std::vector<double> rays = flux("inject_voxel_rays", scene, parameters);
        const std::vector<double> map = flux(kMaps, scene, parameters);
        EXPECT_NEAR(sum(map) / sum(rays), 1.0, 0.005) << scene;
        EXPECT_LT(difference(map, rays), 0.01) << scene;
    }
}

TEST(ShadowMap, WhatAMaskCutsCastsNoShadow) {
    // Spheres over a floor, cut away entirely.
    SceneState state = evaluate(makeBuiltinScene("spheres", parseYaml("{moving: false}", "scene")), 0.0);
    Scene scene = *state.scene;
    for (size_t m = 1; m < scene.materials.size(); ++m) {
        scene.materials[m].alphaMode = AlphaMode::Mask;
        scene.materials[m].baseColor.a = 0;
    }
    state.scene = std::make_shared<Scene>(scene);
    const auto shared = std::make_shared<SceneState>(state);
    Chain map(shared, injectGraph(kMaps + ", bounces: 0"), 8, 8, 1);
    Chain rays(shared, injectGraph("inject_voxel_rays, bounces: 0"), 8, 8, 1);
    EXPECT_LT(difference(directFlux(map), directFlux(rays)), 1e-3);
}

TEST(ShadowMap, IndirectLightOfCornellIsThatOfVoxelRays) {
    const auto indirect = [](const std::string& inject) {
        Chain chain("cornell", "{lights: point}",
                    graphYaml({"gbuffer", "voxelize", "place_surfels, points_per_voxel: 8",
                               inject + ", bounces: 4", "gather_irradiance"}));
        return mean(chain.image("indirect"));
    };
    EXPECT_NEAR(indirect(kMaps) / indirect("inject_voxel_rays"), 1.0, 0.02);
}

ImageF directImage(const std::string& scene, const std::string& parameters, const std::string& pass,
                   const std::string& resolution = "1024") {
    return Chain(scene, parameters,
                 graphYaml({"gbuffer, samples_per_pixel_edge: 2", "render_rsm, rsm_resolution: " + resolution,
                            pass}),
                 64, 64)
        .image("direct");
}

TEST(ShadowMap, OfPixelsShowsFlatSurfacesAsRaysDo) {
    for (const std::string light : {"point", "spot", "directional"}) {
        const ImageF map = directImage("plane", "{light: " + light + "}", "direct_shadow_maps", "64");
        const ImageF rays = directImage("plane", "{light: " + light + "}", "direct_shadow_rays");
        for (size_t i = 0; i < rays.data.size(); ++i)
            ASSERT_NEAR(map.data[i], rays.data[i], 1e-4f * rays.data[i] + 1e-7f) << light << " " << i;
    }
}

TEST(ShadowMap, OfPixelsComesNearToRays) {
    // What stays with fine maps lies along edges of the room, which pixels' centers fall on
    for (const std::string light : {"point", "spot", "sun"}) {
        const ImageF rays = directImage("cornell", "{lights: " + light + "}", "direct_shadow_rays");
        const auto apart = [&](const std::string& resolution) {
            const ImageF map =
                directImage("cornell", "{lights: " + light + "}", "direct_shadow_maps", resolution);
            double sum = 0;
            for (size_t i = 0; i < rays.data.size(); ++i)
                sum += std::abs(double(map.data[i]) - double(rays.data[i]));
            sum /= mean(rays) * double(rays.data.size());
            std::printf("%s, maps of %s texels a side: %.4f\n", light.c_str(), resolution.c_str(), sum);
            return sum;
        };
        const double coarse = apart("128"), fine = apart("2048");
        EXPECT_LT(fine, 0.5 * coarse);
        EXPECT_LT(fine, 0.003);
    }
}

TEST(ShadowMap, OfPixelsNamesLightsWithoutAViewpoint) {
    EXPECT_CONTAINS(errorOf([] { directImage("cornell", "{lights: area}", "direct_shadow_maps"); }),
                    "render_rsm: emissive surfaces have no single viewpoint to render a shadow map from; "
                    "use direct_shadow_rays");
}

TEST(ShadowMap, BadInputIsNamed) {
    const auto state = [](const std::string& scene, const std::string& parameters) {
        return std::make_shared<SceneState>(
            evaluate(makeBuiltinScene(scene, parseYaml(parameters, "scene")), 0.0));
    };
    const auto expectError = [](const std::shared_ptr<const SceneState>& scene, const std::string& parameters,
                                const std::string& text) {
        const std::string graph = injectGraph(kMaps + parameters, "8");
        EXPECT_CONTAINS(errorOf([&] { Chain(scene, graph, 8, 8, 1); }), text);
    };
    expectError(state("cornell", "{lights: area}"), "",
                "inject_voxel_rays: emissive surfaces have no single viewpoint to render a shadow map from; "
                "use 'direct: shadow_rays'");
    SceneState sky = *state("white_room", "{}");
    Scene scene = *sky.scene;
    scene.environment.radiance = glm::vec3(1.0f);
    sky.scene = std::make_shared<Scene>(scene);
    expectError(std::make_shared<SceneState>(sky), "", "an environment has no single viewpoint");
    expectError(state("white_room", "{intensity: 0}"), "", "inject_voxel_rays: the scene has no lights");
    expectError(state("white_room", "{}"), ", shadow_resolution: 0", "out of range");
    expectError(state("white_room", "{}"), ", paths_per_point: 0", "out of range");
}

}  // namespace
}  // namespace voxray::test
