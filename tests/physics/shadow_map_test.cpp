// Direct light by shadow maps, against closed forms and against shadow rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "passes/common/voxels/voxels.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

const std::string kMaps = "inject_voxel_rays, direct: shadow_maps";

std::string injectGraph(const std::string& inject, const std::string& resolution = "24") {
    return graphYaml({"voxelize, resolution: " + resolution, "place_surfels, points_per_voxel: 16", inject});
}

std::vector<double> directFlux(Chain& chain) {
    return greenFlux(chain, irradiance(chain).direct);
}

TEST(ShadowMap, ClosedRoomCatchesAllLight) {
    // A point light of 2 W/sr in a closed room: 8 pi W arrive, and the albedo's part of that again with each
    // bounce.
    Chain chain("white_room", "{albedo: 0.5, intensity: 2}", injectGraph(kMaps + ", paths_per_point: 4, bounces: 2"));
    EXPECT_NEAR(sum(directFlux(chain)) / (8 * kPi), 1.0, 0.01);
    EXPECT_NEAR(indirectFlux(chain) / (8 * kPi * 0.75), 1.0, 0.02);
}

TEST(ShadowMap, SpotsTakeOneMapOrTheCube) {
    // A uniform cone: 2 pi (1 - cos) I, narrower and wider than a side of the cube.
    for (const double degrees : {30.0, 80.0}) {
        Chain chain(roomWithSpot(degrees), injectGraph(kMaps + ", bounces: 0"), 8, 8);
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
        const auto& voxels = chain.get<SurfaceVoxels>("voxels");
        const std::vector<float> area = readAreas(chain, irradiance(chain).area);
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
                const double measured = flux[face] / (area[face] * size * size);
                worst = std::max(worst, std::abs(measured / (expected / parts) - 1));
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
        EXPECT_LT(meanDifference(map, rays), 0.01) << scene;
    }
}

TEST(ShadowMap, WhatAMaskCutsCastsNoShadow) {
    // Spheres over a floor, cut away entirely.
    const auto scene = builtinScene("spheres", "{moving: false}");
    const Material floor = scene->materials.at(0);
    cutAway(scene)->materials.at(0) = floor;
    const State state = evaluated(scene);
    Chain map(state, injectGraph(kMaps + ", bounces: 0"), 8, 8);
    Chain rays(state, injectGraph("inject_voxel_rays, bounces: 0"), 8, 8);
    EXPECT_LT(meanDifference(directFlux(map), directFlux(rays)), 1e-3);
}

TEST(ShadowMap, IndirectLightOfCornellIsThatOfVoxelRays) {
    const auto indirect = [](const std::string& inject) {
        return meanIndirect("cornell", "{lights: point}",
                            graphYaml({"gbuffer", "voxelize", "place_surfels, points_per_voxel: 8",
                                       inject + ", bounces: 4", "gather_irradiance"}));
    };
    EXPECT_NEAR(indirect(kMaps) / indirect("inject_voxel_rays"), 1.0, 0.02);
}

ImageF directImage(const std::string& scene, const std::string& parameters, const std::string& pass,
                   const std::string& resolution = "1024") {
    return Chain(scene, parameters,
                 graphYaml({"gbuffer, samples_per_pixel_edge: 2", "render_rsm, rsm_resolution: " + resolution, pass}),
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
            const double difference = meanDifference(
                directImage("cornell", "{lights: " + light + "}", "direct_shadow_maps", resolution), rays);
            std::printf("%s, maps of %s texels a side: %.4f\n", light.c_str(), resolution.c_str(), difference);
            return difference;
        };
        const double coarse = apart("128"), fine = apart("2048");
        EXPECT_LT(fine, 0.5 * coarse);
        EXPECT_LT(fine, 0.003);
    }
}

TEST(ShadowMap, OfPixelsNamesLightsWithoutAViewpoint) {
    EXPECT_ERROR("use direct_shadow_rays", directImage("cornell", "{lights: area}", "direct_shadow_maps"));
}

TEST(ShadowMap, BadInputIsNamed) {
    const auto errorWith = [](const State& scene, const std::string& parameters = "") {
        return errorOf([&] { Chain(scene, injectGraph(kMaps + parameters, "8"), 8, 8); });
    };
    EXPECT_CONTAINS(errorWith(builtin("cornell", "{lights: area}")), "use 'direct: shadow_rays'");
    const auto sky = builtinScene("white_room");
    sky->environment.radiance = glm::vec3(1.0f);
    EXPECT_CONTAINS(errorWith(evaluated(sky)), "an environment");
    EXPECT_CONTAINS(errorWith(builtin("white_room", "{intensity: 0}")), "inject_voxel_rays: the scene has no lights");
    for (const char* wrong : {", shadow_resolution: 0", ", paths_per_point: 0"})
        EXPECT_CONTAINS(errorWith(builtin("white_room"), wrong), "out of range");
}

}  // namespace
}  // namespace voxray::test
