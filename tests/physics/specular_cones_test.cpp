// Specular cones: energy against the reference's BSDF, mirrors, Lambert surfaces untouched.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "passes/common/view/gbuffer.h"
#include "scene/shapes.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

/// A built-in scene with all its materials changed.
template <typename Change>
std::shared_ptr<const SceneState> changed(const std::string& scene, const std::string& parameters,
                                          const Change& change) {
    auto copy = std::make_shared<Scene>(*makeBuiltinScene(scene, parseYaml(parameters, "scene")));
    for (Material& material : copy->materials) change(material);
    return std::make_shared<SceneState>(evaluate(copy, 0.0));
}

std::string coneGraph(const std::string& gbuffer, const std::string& resolution, const std::string& inject,
                      const std::string& filter, const std::string& gather) {
    return graphYaml({"gbuffer, " + gbuffer, "voxelize, resolution: " + resolution,
                      "inject_light_rays, " + inject, "filter_voxels, " + filter, "gather_cones, " + gather});
}

/// Mean of what surfaces reflect where all of them emit 1, by cones and by the reference. Voxels hold what
/// light of that does to Lambert surfaces, too: 1 + the diffuse albedo.
void expectFurnace(const std::string& name, const std::function<void(Material&)>& change) {
    const auto state = changed("furnace", "{shape: box, albedo: 1, emission: 1}", change);
    Chain reference(state, graphYaml({"path_trace, spp: 1024, bounces: 0"}), 16, 16, 1);
    const double expected = mean(reference.image("final")) - 1.0;
    Chain cones(state,
                coneGraph("samples_per_pixel_edge: 1", "32", "rays_per_light: 65536, bounces: 0",
                          "emission: true", "cones: 16"),
                16, 16, 1);
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
                    coneGraph("samples_per_pixel_edge: 2", "32", "rays_per_light: 65536, bounces: 2",
                              "emission: false", "cones: 6, specular: " + cones));
        return chain.image("indirect").data;
    };
    EXPECT_EQ(run("7"), run("0"));
}

/// A room whose wall at -Z is a mirror, a box before it, and a point light. With one bounce the mirror shows
/// what light does to the others directly: nothing else reflects in two ways.
std::shared_ptr<const SceneState> mirrorRoom(float roughness) {
    SceneBuilder b("mirror");
    const uint32_t white = b.lambert("white", glm::vec3(0.7f)), red = b.lambert("red", {0.7f, 0.2f, 0.1f});
    Material metal;
    metal.roughness = roughness;
    metal.baseColor = glm::vec4(0.9f, 0.8f, 0.6f, 1.0f);
    const uint32_t mirror = b.material(metal);
    b.room({-1, 0, -1}, {1, 2, 1}, {red, white, white, white, mirror, white});
    b.box("box", {0.3f, 0, 0}, {0.5f, 0.7f, 0.5f}, 0.3f, red);
    b.pointLight({-0.3f, 1.6f, 0.3f}, glm::vec3(1));
    b.camera({-0.2f, 1, 0.9f}, {0, 0.9f, -1}, 70);
    return std::make_shared<SceneState>(evaluate(b.finish(), 0.0));
}

/// Over the pixels that show the mirror: mean difference between the cones' image and the reference, and
/// the ratio of their means. The others show light that the mirror throws at them, which voxels don't hold.
std::pair<double, double> mirrorError(float roughness, const std::string& cones,
                                      const std::string& resolution, const std::string& layout,
                                      const ImageF& expected) {
    Chain chain(mirrorRoom(roughness),
                coneGraph("samples_per_pixel_edge: 2", resolution, "rays_per_light: 524288, bounces: 0",
                          "layout: " + layout, "cones: 5, stride: 16, specular: " + cones),
                32, 32, 1);
    const ImageF image = chain.image("indirect");
    const auto positions = chain.readImage<glm::vec4>(chain.graph().resource<GBuffer>("gbuffer")->position);
    double difference = 0, own = 0, theirs = 0;
    for (size_t i = 0; i < 32 * 32; ++i) {
        const size_t texel = 128 * (i / 32) + 2 * (i % 32);
        if (positions[texel].z > -0.999f || positions[texel + 65].z > -0.999f) continue;
        for (size_t channel = 3 * i; channel < 3 * i + 3; ++channel) {
            difference += std::abs(double(image.data[channel]) - expected.data[channel]);
            own += image.data[channel];
            theirs += expected.data[channel];
        }
    }
    return {difference / theirs, own / theirs};
}

TEST(SpecularCones, MirrorsConvergeToTheReference) {
    Chain reference(mirrorRoom(0), graphYaml({"path_trace, spp: 256, bounces: 1"}), 32, 32, 1);
    const ImageF expected = reference.image("indirect");
    const double coarse = mirrorError(0, "1", "16", "dense", expected).first;
    for (const std::string layout : {"dense", "svo"}) {
        const auto [fine, ratio] = mirrorError(0, "1", "64", layout, expected);
        EXPECT_NEAR(ratio, 1.0, 0.03) << layout;
        EXPECT_LT(fine, 0.06) << layout;
        EXPECT_LT(fine, 0.4 * coarse) << layout;
    }
}

TEST(SpecularCones, MoreConesDescribeARoughLobeBetter) {
    Chain reference(mirrorRoom(0.6f), graphYaml({"path_trace, spp: 256, bounces: 1"}), 32, 32, 1);
    const ImageF expected = reference.image("indirect");
    const auto [one, oneRatio] = mirrorError(0.6f, "1", "64", "dense", expected);
    const auto [many, manyRatio] = mirrorError(0.6f, "19", "64", "dense", expected);
    EXPECT_NEAR(manyRatio, 1.0, 0.04);
    EXPECT_LT(many, 0.12);
    EXPECT_LT(many, 0.4 * one);
}

TEST(SpecularCones, DirectLightHasHighlights) {
    for (const float roughness : {0.3f, 0.7f}) {
        const auto state = mirrorRoom(roughness);
        Chain reference(state, graphYaml({"path_trace, spp: 256, bounces: 0"}), 32, 32, 1);
        Chain chain(state, graphYaml({"gbuffer, samples_per_pixel_edge: 8", "direct_shadow_rays"}), 32, 32,
                    1);
        const ImageF expected = reference.image("final"), direct = chain.image("direct");
        double difference = 0;
        for (size_t i = 0; i < direct.data.size(); ++i)
            difference += std::abs(double(direct.data[i]) - expected.data[i]);
        EXPECT_LT(difference / double(direct.data.size()), 0.005 * mean(expected)) << roughness;
    }
}

}  // namespace
}  // namespace voxray::test
