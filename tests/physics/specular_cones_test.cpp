// Specular cones: energy against the reference's BSDF, mirrors, Lambert surfaces untouched.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/physics/mirror_scene.h"

namespace voxray::test {
namespace {

std::string coneGraph(const std::string& gbuffer, const std::string& resolution, const std::string& inject,
                      const std::string& filter, const std::string& gather) {
    return graphYaml({"gbuffer, " + gbuffer, "voxelize, resolution: " + resolution, "inject_light_rays, " + inject,
                      "filter_voxels, " + filter, "gather_cones, visibility: voxels, " + gather});
}

/// Mean of what surfaces reflect where all of them emit 1, by cones and by the reference. Voxels hold what
/// light of that does to Lambert surfaces, too: 1 + the diffuse albedo.
void expectFurnace(const std::string& name, const std::function<void(Material&)>& change) {
    const State state = withMaterials("furnace", "{shape: box, albedo: 1, emission: 1}", change);
    Chain reference(state, graphYaml({"path_trace, spp: 1024, bounces: 0"}), 16, 16);
    const double expected = mean(reference.image("final")) - 1.0;
    Chain cones(state,
                coneGraph("samples_per_pixel_edge: 1", "32", "rays_per_light: 65536, bounces: 0", "emission: true",
                          "cones: 16"),
                16, 16);
    const Material& wall = state->scene->materials[0];
    const double seen = 1.0 + wall.baseColor.r * (1.0 - wall.metallic);
    EXPECT_NEAR(mean(cones.image("indirect")) / (expected * seen), 1.0, 0.02) << name << " " << expected;
}

TEST(SpecularCones, KeepTheEnergyOfAFurnaceOfMetal) {
    for (const float roughness : {0.0f, 0.3f, 1.0f})
        expectFurnace("roughness " + std::to_string(roughness), [&](Material& m) {
            m.metallic = 1;
            m.roughness = roughness;
        });
}

TEST(SpecularCones, KeepTheEnergyOfAFurnaceOfVarnish) {
    for (const float ior : {1.5f, 3.0f})
        expectFurnace("ior " + std::to_string(ior), [&](Material& m) {
            m.baseColor = glm::vec4(0.6f, 0.6f, 0.6f, 1.0f);
            m.metallic = 0;
            m.specular = 1;
            m.ior = ior;
            m.roughness = 0.3f;
        });
}

TEST(SpecularCones, LeaveLambertSurfacesAlone) {
    const auto run = [](const std::string& cones) {
        Chain chain("cornell", "{lights: point}",
                    coneGraph("samples_per_pixel_edge: 2", "32", "rays_per_light: 65536, bounces: 2", "emission: false",
                              "cones: 6, specular: " + cones));
        return chain.image("indirect").data;
    };
    EXPECT_EQ(run("7"), run("0"));
}

State mirrorRoom(float roughness) {
    return wallRoom(metal({0.9f, 0.8f, 0.6f}, roughness));
}

/// Over the pixels that show the mirror, by cones and by the reference, as errorAt() has it. The others show
/// light that the mirror throws at them, which voxels don't hold.
std::pair<double, double> mirrorError(float roughness, const std::string& cones, const std::string& resolution,
                                      const std::string& layout, const ImageF& expected) {
    Chain chain(mirrorRoom(roughness),
                coneGraph("samples_per_pixel_edge: 2", resolution, "rays_per_light: 524288, bounces: 0",
                          "layout: " + layout, "cones: 5, stride: 16, specular: " + cones));
    return errorAt(chain, "indirect", expected, -0.999f);
}

TEST(SpecularCones, MirrorsConvergeToTheReference) {
    const ImageF expected = pathTraced(mirrorRoom(0), 256, 1);
    const double coarse = mirrorError(0, "1", "16", "dense", expected).first;
    for (const std::string layout : {"dense", "svo"}) {
        const auto [fine, ratio] = mirrorError(0, "1", "64", layout, expected);
        EXPECT_NEAR(ratio, 1.0, 0.03) << layout;
        EXPECT_LT(fine, 0.06) << layout;
        EXPECT_LT(fine, 0.4 * coarse) << layout;
    }
}

TEST(SpecularCones, MoreConesDescribeARoughLobeBetter) {
    const ImageF expected = pathTraced(mirrorRoom(0.6f), 256, 1);
    const auto [one, oneRatio] = mirrorError(0.6f, "1", "64", "dense", expected);
    const auto [many, manyRatio] = mirrorError(0.6f, "19", "64", "dense", expected);
    EXPECT_NEAR(manyRatio, 1.0, 0.04);
    EXPECT_LT(many, 0.12);
    EXPECT_LT(many, 0.4 * one);
}

TEST(SpecularCones, DirectLightHasHighlights) {
    for (const float roughness : {0.3f, 0.7f}) {
        const auto state = mirrorRoom(roughness);
        Chain reference(state, graphYaml({"path_trace, spp: 256, bounces: 0"}), 32, 32);
        Chain chain(state, graphYaml({"gbuffer, samples_per_pixel_edge: 8", "direct_shadow_rays"}), 32, 32);
        EXPECT_LT(meanDifference(chain.image("direct"), reference.image("final")), 0.005) << roughness;
    }
}

}  // namespace
}  // namespace voxray::test
