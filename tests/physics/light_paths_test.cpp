// Paths of light, from rays and from shadow maps, by write mode and kind of bounce, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "passes/common/voxels/voxels.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

/// What a graph of one injection left in the voxels, green channel.
struct Lit {
    Lit(const std::string& scene, const std::string& parameters, const std::string& voxelize, const std::string& inject)
        : chain(scene, parameters, graphYaml({"voxelize, " + voxelize, inject})) {
        take();
    }
    Lit(State state, const std::string& voxelize, const std::string& inject)
        : chain(std::move(state), graphYaml({"voxelize, " + voxelize, inject}), 32, 32) {
        take();
    }
    void take() {
        voxels = &chain.get<SurfaceVoxels>("voxels");
        direct = greenFlux(chain, irradiance(chain).direct);
        indirect = greenFlux(chain, irradiance(chain).indirect);
        area = readAreas(chain, irradiance(chain).area);
    }
    /// The face (index into direct, indirect and area) of the voxel round a point.
    size_t face(glm::vec3 position, size_t direction) {
        const gpu::VoxelGrid& g = voxels->grid;
        const glm::uvec3 v((position - g.origin) / g.voxelSize);
        const uint32_t word = (v.z * g.resolution.y + v.y) * g.wordsPerRow + v.x / 32, bit = 1u << (v.x % 32);
        const uint32_t bits = chain.read<uint32_t>(voxels->occupancy)[word];
        EXPECT_TRUE(bits & bit);
        const uint32_t before = chain.read<uint32_t>(voxels->rank)[word];
        return size_t(before + uint32_t(std::popcount(bits & (bit - 1)))) * 6 + direction;
    }
    /// W/m²
    double mean(const std::vector<double>& flux, size_t at) const {
        return flux[at] / (area[at] * voxels->grid.voxelSize * voxels->grid.voxelSize);
    }
    Chain chain;
    const SurfaceVoxels* voxels = nullptr;
    std::vector<double> direct, indirect;
    std::vector<float> area;
};

std::string messageOf(const std::string& scene, const std::string& parameters, const std::string& inject) {
    return errorOf([&] { Lit(scene, parameters, "resolution: 8", inject); });
}

TEST(LightPaths, MirrorBouncesSumToTheGeometricSeries) {
    // A closed room keeps all light: each bounce leaves the albedo's part of it, whichever way it goes.
    Lit lit("white_room", "{albedo: 0.5, intensity: 2}", "resolution: 24",
            "inject_light_rays, secondary: mirror, bounces: 3");
    EXPECT_NEAR(sum(lit.indirect) / (4 * kPi * 2 * (0.5 + 0.25 + 0.125)), 1.0, 1e-3);
}

TEST(LightPaths, MaterialsKeepTheEnergyOfTheirLobes) {
    // Lambert surfaces reflect their albedo's part. Perfect mirrors that lose nothing send on all of it, but
    // for what comes straight from a point light where there are to be no caustics.
    Lit lambert("white_room", "{albedo: 0.5, intensity: 2}", "resolution: 24",
                "inject_light_rays, secondary: material, bounces: 2");
    EXPECT_NEAR(sum(lambert.indirect) / (4 * kPi * 2 * (0.5 + 0.25)), 1.0, 5e-3);
    auto scene = builtinScene("white_room", "{intensity: 2}");
    for (Material& material : scene->materials) {
        material.baseColor = glm::vec4(1);
        material.metallic = 1, material.roughness = 0;
    }
    const auto state = evaluated(scene);
    const std::string inject = "inject_light_rays, rays_per_light: 65536, secondary: material, bounces: 3";
    Lit mirrors(state, "resolution: 24", inject);
    EXPECT_NEAR(sum(mirrors.indirect) / (4 * kPi * 2 * 3), 1.0, 1e-3);
    EXPECT_EQ(sum(Lit(state, "resolution: 24", inject + ", caustics: false").indirect), 0.0);
}

TEST(LightPaths, SurfacesWithShadingNormalsScatterTheLightOfTheReference) {
    // The sun on a floor whose normals are tilted by 40° towards it: the ceiling gets the floor's light
    const auto scene = [](const Material& floor) {
        SceneBuilder b("tilted");
        b.quad("floor", {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, b.material(floor));
        b.quad("ceiling", {-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, b.lambert("grey", glm::vec3(0.5f)));
        b.directionalLight({-1, -1, 0}, glm::vec3(4));
        b.camera({0, 0.5f, -0.3f}, {0, 2, 0}, 20);
        const auto state = evaluated(b);
        const float angle = float(40 * kPi / 180);
        for (uint32_t t = 0; t < 2; ++t)
            for (int corner = 0; corner < 3; ++corner)
                state->geometry.attributes[state->geometry.triangles[t][corner]].normal = {std::sin(angle),
                                                                                           std::cos(angle), 0};
        return state;
    };
    const Material lambert{.name = "lambert", .metallic = 0, .specular = 0},
        glossy{.name = "glossy", .metallic = 1, .roughness = 0.4f};
    const auto compare = [&](const Material& floor, const std::vector<std::string>& injections) {
        const State state = scene(floor);
        const double reference = meanIndirect(*state, graphYaml({"path_trace, spp: 512, bounces: 1"}), 16, 16);
        for (const std::string& inject : injections) {
            const double injected =
                meanIndirect(*state,
                             graphYaml({"gbuffer, samples_per_pixel_edge: 2", "voxelize, resolution: 24",
                                        inject + ", bounces: 1", "gather_irradiance"}),
                             16, 16);
            std::printf("%s, %s: %.4f of the reference\n", floor.name.c_str(), inject.c_str(), injected / reference);
            EXPECT_NEAR(injected / reference, 1, 0.03) << inject;
        }
    };
    const std::string rays = "inject_light_rays, rays_per_light: 524288";
    compare(lambert, {rays, rays + ", secondary: material", "inject_rsm, rsm_resolution: 768"});
    compare(glossy, {rays + ", secondary: material"});
}

TEST(LightPaths, WithoutSecondaryRaysThereIsDirectLightOnly) {
    Lit lit("white_room", "{intensity: 2}", "resolution: 16",
            "inject_light_rays, rays_per_light: 16384, secondary: none, bounces: 3");
    EXPECT_NEAR(sum(lit.direct) / (4 * kPi * 2), 1.0, 1e-3);
    EXPECT_EQ(sum(lit.indirect), 0.0);
}

TEST(LightPaths, EveryWriteGivesTheClosedFormBeforeAWall) {
    // A point light of 2 W/sr at 1 m from each wall of a room: 2 W/m² in the wall's center.
    for (const std::string write : {"average", "max", "moving_average, white: 4", "none"}) {
        Lit lit("white_room", "{intensity: 2}", "resolution: 25",
                "inject_light_rays, rays_per_light: 1048576, secondary: none, write: " + write);
        EXPECT_NEAR(lit.mean(lit.direct, lit.face({0.999f, 0, 0}, 1)), 2.0, 0.05) << write;
    }
}

TEST(LightPaths, BeamsWidenOverMirrorBounces) {
    // One mirror bounce in a room of albedo 0.5: the light's image behind the far wall is 3 m from a wall's
    // center, its four images next to it are further off the normal; the largest is 0.5 * 2 / 9 W/m².
    Lit lit("white_room", "{albedo: 0.5, intensity: 2}", "resolution: 25",
            "inject_light_rays, rays_per_light: 1048576, secondary: mirror, bounces: 1, write: max");
    EXPECT_NEAR(lit.mean(lit.indirect, lit.face({0, -0.999f, 0}, 2)), 1.0 / 9, 0.02 / 9);
}

TEST(LightPaths, MaxIsTheIrradianceAtTheNearestPoint) {
    // Over the plane, 1 m below the light: 1 / d³ at the point of each voxel that is nearest to the light.
    const std::string inject = "inject_light_rays, rays_per_light: 1048576, secondary: none, write: ";
    Lit average("plane", "{}", "resolution: 24, samples_per_voxel_edge: 4", inject + "average");
    Lit max("plane", "{}", "resolution: 24, samples_per_voxel_edge: 4", inject + "max");
    const float half = 0.5f * max.voxels->grid.voxelSize;
    double expected = 0;
    for (int x = 0; x < 24; ++x)
        for (int z = 0; z < 24; ++z) {
            const glm::vec2 center = (glm::vec2(x, z) - 11.5f) * (2 * half);
            const glm::vec2 nearest = glm::max(glm::abs(center) - half, glm::vec2(0.0f));
            const size_t face = max.face({center.x, 0, center.y}, 2);
            expected += std::pow(1 + double(glm::dot(nearest, nearest)), -1.5) * max.area[face] * 4 * half * half;
        }
    EXPECT_NEAR(sum(max.direct) / expected, 1.0, 0.02);
    EXPECT_LT(sum(average.direct), 0.9 * expected);
}

TEST(LightPaths, LightOutsideTheGridShinesIntoIt) {
    // The grid holds the ground alone, 10 m square; the light hangs 1 m above, and sends it I * solid angle.
    for (const std::string pass : {"inject_light_rays", "inject_rsm"}) {
        Lit lit("plane", "{intensity: 3}", "resolution: 16", pass + ", secondary: none");
        EXPECT_NEAR(sum(lit.direct) / (3 * 4 * std::asin(25.0 / 26)), 1.0, 0.005) << pass;
    }
}

TEST(LightPaths, ScenesWithoutLightsAreRefused) {
    for (const std::string pass : {"inject_light_rays", "inject_rsm"})
        EXPECT_CONTAINS(messageOf("white_room", "{intensity: 0}", pass), pass + ": the scene has no lights");
}

TEST(LightPaths, OneVoxelIsRefusedUnlessExposureIsOff) {
    const auto make = [] { Lit("white_room", "{}", "resolution: 1", "inject_light_rays, rays_per_light: 4096"); };
    EXPECT_CONTAINS(errorOf(make), "visibility_rays");
    Lit lit("white_room", "{}", "resolution: 1, visibility_rays: 0",
            "inject_light_rays, rays_per_light: 4096, secondary: none");
    EXPECT_NEAR(sum(lit.direct) / (4 * kPi), 1.0, 1e-3);
}

TEST(LightPaths, WhatHasNoIrradianceIsRefused) {
    for (const std::string write : {"max", "moving_average", "none"}) {
        const std::string inject = "inject_light_rays, write: " + write;
        EXPECT_CONTAINS(messageOf("white_room", "{}", inject), "'write: " + write + "'");
        EXPECT_CONTAINS(messageOf("furnace", "{}", inject + ", secondary: none"), "emissive surface");
    }
    EXPECT_CONTAINS(messageOf("white_room", "{}", "inject_light_rays, rays_per_light: 0"), "out of range");
}

TEST(InjectRsm, ClosedRoomCatchesAllLight) {
    Lit lit("white_room", "{albedo: 0.5, intensity: 2}", "resolution: 24",
            "inject_rsm, rsm_resolution: 128, bounces: 2");
    EXPECT_NEAR(sum(lit.direct) / (4 * kPi * 2), 1.0, 0.005);
    EXPECT_NEAR(sum(lit.indirect) / (4 * kPi * 2 * 0.75), 1.0, 0.01);
}

TEST(InjectRsm, AgreesWithLightRays) {
    // Totals agree closely; voxel by voxel some twenty rows of texels, one more or less, make the difference.
    for (const std::string light : {"point", "spot", "directional"}) {
        const std::string scene = "{light: " + light + "}";
        Lit rsm("plane", scene, "resolution: 16", "inject_rsm, secondary: none, rsm_resolution: 512");
        Lit rays("plane", scene, "resolution: 16", "inject_light_rays, secondary: none, rays_per_light: 262144");
        EXPECT_NEAR(sum(rsm.direct) / sum(rays.direct), 1.0, 0.005) << light;
        EXPECT_LT(meanDifference(rsm.direct, rays.direct), 0.03) << light;
    }
    Lit rsm("cornell", "{lights: point}", "resolution: 16", "inject_rsm, rsm_resolution: 256, bounces: 3");
    Lit rays("cornell", "{lights: point}", "resolution: 16", "inject_light_rays, rays_per_light: 524288, bounces: 3");
    EXPECT_NEAR(sum(rsm.direct) / sum(rays.direct), 1.0, 0.005);
    EXPECT_NEAR(sum(rsm.indirect) / sum(rays.indirect), 1.0, 0.01);
    EXPECT_LT(meanDifference(rsm.direct, rays.direct), 0.03);
    EXPECT_LT(meanDifference(rsm.indirect, rays.indirect), 0.1);  // Noise of the bounces.
}

TEST(InjectRsm, WideSpotsTakeTheCube) {
    // From the center of a room, a uniform cone of 80°: 2 pi (1 - cos 80°) I.
    Lit lit(roomWithSpot(80), "resolution: 16", "inject_rsm, secondary: none");
    EXPECT_NEAR(sum(lit.direct) / (2 * kPi * (1 - std::cos(80 * kPi / 180 - 0.005))), 1.0, 0.005);
}

TEST(InjectRsm, LightsWithoutAViewpointAreRefused) {
    EXPECT_CONTAINS(messageOf("cornell", "{lights: area}", "inject_rsm"), "emissive surfaces");
}

}  // namespace
}  // namespace voxray::test
