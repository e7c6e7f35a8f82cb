// The light tree on the device: direct light of many lights, against one ray to each and against the path tracer.
#include <gtest/gtest.h>

#include "scene/load.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

struct Mean {
    double value, deviation;
};

/// Mean of an image over frames, which draw their own random numbers, and its standard deviation.
Mean meanOfFrames(const State& state, const std::vector<std::string>& passes, const char* port = "direct",
                  uint32_t frames = 16) {
    Chain chain(state, graphYaml(passes), 32, 18);
    std::vector<double> means;
    for (uint32_t frame = 1; frame <= frames; ++frame) {
        chain.runFrame(frame);
        means.push_back(mean(chain.image(port)));
    }
    double sum = 0, squares = 0;
    for (const double m : means) sum += m / frames;
    for (const double m : means) squares += (m - sum) * (m - sum);
    return {sum, std::sqrt(squares / (frames * (frames - 1.0)))};
}

void expectEqual(const Mean& a, const Mean& b, const std::string& what, double most = 0.01) {
    const double deviation = std::hypot(a.deviation, b.deviation);
    std::printf("%s: %.5f, %.5f, z %.2f\n", what.c_str(), a.value, b.value, (a.value - b.value) / deviation);
    EXPECT_NEAR(a.value, b.value, 4 * deviation + 1e-5 * b.value) << what;
    EXPECT_LT(deviation, most * b.value) << what;
}

State lamps(const std::string& kind, int count) {
    return builtin("lamps", fmt::format("{{kind: {}, count: {}}}", kind, count));
}

TEST(SampledLights, SampledLightIsThatOfARayToEachLight) {
    for (const std::string kind : {"point", "spot"})
        for (const std::string candidates : {"1", "4"}) {
            const std::string shadows = "direct_shadow_rays, light_samples: 16, candidates: " + candidates;
            expectEqual(meanOfFrames(lamps(kind, 60), {"gbuffer", shadows + ", exact_lights: 0"}),
                        {mean(Chain(lamps(kind, 60), graphYaml({"gbuffer", shadows + ", exact_lights: 60"}), 32, 18)
                                  .image("direct")),
                         0},
                        kind + ", " + candidates);
        }
}

TEST(SampledLights, SampledLightOfAllKindsIsThatOfThePathTracer) {
    const auto scene = builtinScene("lamps", "{count: 90}");
    Light& sun = scene->lights.emplace_back();
    sun.type = LightType::Directional;
    sun.intensity = glm::vec3(0.5f);
    sun.direction = {0, -1, 0};
    // A corner of the hall without lamps: the image has no lamps, whose edges are as coarse as texels of the G-buffer.
    // Those of shadows are, too: 2 x 2 texels lack 0.3 % of the light
    Camera& camera = scene->cameras[0];
    camera.position = {-10.5f, 1, -10.5f};
    camera.forward = glm::normalize(glm::vec3(-1, 0, -1));
    camera.up = {0, 1, 0};
    const State state = evaluated(scene);
    const Mean expected = meanOfFrames(state, {"path_trace, spp: 256, bounces: 0"}, "final", 4);
    for (const std::string candidates : {"1", "8"})
        for (const std::string exact : {"0", "60"})
            expectEqual(meanOfFrames(state,
                                     {"gbuffer, samples_per_pixel_edge: 8",
                                      "direct_shadow_rays, light_samples: 2, candidates: " + candidates +
                                          ", exact_lights: " + exact,
                                      "composite"},
                                     "final"),
                        expected, candidates + " candidates, " + exact + " exact");
}

TEST(SampledLights, TexturedLampsByTheTreeAreAsBrightAsThoseWithACandidateEach) {
    const auto scene = builtinScene("lamps", "{count: 15, kind: surface}");
    Texture texture{.name = "lamp", .width = 4, .height = 4};
    for (int i = 0; i < 64; ++i) texture.rgba.push_back(i % 12 < 4 ? 255 : 20);
    scene->textures.push_back(texture);
    for (Material& m : scene->materials)
        if (m.name == "lamp") m.emissiveTexture.texture = 0;
    for (Mesh& mesh : scene->meshes)
        if (mesh.name == "lamps") {
            mesh.texCoords0.resize(mesh.positions.size());
            for (size_t i = 0; i < mesh.positions.size(); ++i)
                mesh.texCoords0[i] = 3.0f * glm::vec2(i % 4 == 1 || i % 4 == 2, i % 4 >= 2);
        }
    const State state = evaluated(scene);
    const auto light = [&](const std::string& candidates) {
        return meanOfFrames(state, {"gbuffer", "direct_shadow_rays, light_samples: 16, candidates: " + candidates});
    };
    const Mean each = light("32");
    expectEqual(light("1"), each, "a triangle by the tree");
    expectEqual(light("8"), each, "of eight");
}

TEST(SampledLights, LightVoxelsAsARayToEachLightDoes) {
    // 120 lights are sampled; those of either half get a ray each
    const State all = lamps("point", 120);
    const auto voxelLight = [&](size_t first, size_t count) {
        const auto some = std::make_shared<SceneState>(*all);
        some->lights.assign(all->lights.begin() + ptrdiff_t(first), all->lights.begin() + ptrdiff_t(first + count));
        return mean(Chain(*some,
                          graphYaml({"gbuffer", "voxelize, resolution: 64", "place_surfels",
                                     "inject_voxel_rays, bounces: 0", "gather_irradiance, light: direct", "composite"}),
                          32, 18)
                        .image("final"));
    };
    EXPECT_NEAR(voxelLight(0, 120) / (voxelLight(0, 60) + voxelLight(60, 60)), 1, 0.02);
}

TEST(SampledLights, FollowsLightsThatMove) {
    const std::string graph = graphYaml({"gbuffer", "direct_shadow_rays, exact_lights: 0, light_samples: 8"});
    const State state = lamps("point", 30);
    Chain moved(*state, graph, 32, 18);
    moved.update(moveLight);
    const auto after = std::make_shared<SceneState>(*state);
    moveLight(*after);
    EXPECT_EQ(moved.image("direct").data, Chain(*after, graph, 32, 18).image("direct").data);
}

TEST(SampledLights, IsLinearAndTheSameInEachRun) {
    const std::string graph = graphYaml({"gbuffer", "direct_shadow_rays, light_samples: 2", "composite"});
    const auto image = [&](int power) {
        return Chain("lamps", fmt::format("{{count: 1000, power: {}}}", power), graph, 32, 18).image("final");
    };
    const ImageF once = image(1000), again = image(1000), bright = image(16000);
    EXPECT_EQ(once.data, again.data);
    for (size_t i = 0; i < once.data.size(); ++i) ASSERT_NEAR(bright.data[i], 16 * once.data[i], 1e-3 * bright.data[i]);
}

TEST(SampledLights, FilterTakesNoiseOffManyPoints) {
    // Shadows of points have no penumbra: what is blurred is the noise of the choice
    const State state = lamps("point", 1000);
    const auto light = [&](const std::string& parameters, const std::string& filter = "") {
        return Chain(state,
                     graphYaml({"gbuffer, samples_per_pixel_edge: 2", "direct_shadow_rays, " + parameters, filter}), 48,
                     27)
            .image("direct");
    };
    const ImageF truth = light("exact_lights: 1000");
    const auto error = [&](const ImageF& image) {
        double sum = 0;
        for (size_t i = 0; i < image.data.size(); ++i)
            sum += std::pow(double(image.data[i]) - double(truth.data[i]), 2);
        return sum;
    };
    const std::string one = "exact_lights: 0, light_samples: 1";
    const ImageF filtered = light(one, "filter_irradiance, light: direct");
    EXPECT_LT(error(filtered), error(light(one)) / 1.5);
    EXPECT_NEAR(mean(filtered) / mean(truth), 1, 0.03);
}

TEST(SampledLights, LessNoiseThanChoiceByPowerAlone) {
    // 10,000 lamps: a choice by power has the variance of lights all over the hall
    const State state = lamps("mixed", 10000);
    const Mean tree = meanOfFrames(state, {"gbuffer", "direct_shadow_rays, light_samples: 8"}, "direct", 8);
    EXPECT_LT(tree.deviation, 0.01 * tree.value);
}

}  // namespace
}  // namespace voxray::test
