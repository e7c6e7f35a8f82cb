// Direct light of skies and lamps: what importance sampling and the filter must keep, and what they gain.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "passes/common/filter/noisy_irradiance.h"
#include "tests/gpu/chain.h"
#include "trace/environment_cdf.h"

namespace voxray::test {
namespace {

/// A sky of radiance 1 over black ground, with a sun of one texel 3 texels above the horizon.
std::shared_ptr<ImageF> sunAndSky(float sun = 4000) {
    auto map = std::make_shared<ImageF>(64, 32, 3);
    for (uint32_t y = 0; y < 16; ++y)
        for (uint32_t x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) map->pixel(x, y)[c] = 1.0f;
    for (int c = 0; c < 3; ++c) map->pixel(40, 8)[c] = sun;
    return map;
}

std::shared_ptr<Scene> withoutLights(const std::string& scene, const std::string& parameters = "{}") {
    const auto copy = builtinScene(scene, parameters);
    copy->lights.clear();
    return copy;
}

State spheresUnder(std::shared_ptr<const ImageF> map, float scale = 1) {
    const auto scene = withoutLights("spheres", "{moving: false}");
    scene->environment = {glm::vec3(scale), std::move(map)};
    return evaluated(scene);
}

State glowingSpheres(float emission = 2) {
    const auto scene = withoutLights("spheres", "{moving: false, count: 6}");
    for (Material& material : scene->materials)
        if (material.name == "sphere") material.emission = glm::vec3(emission);
    return evaluated(scene);
}

/// `parameters` of the pass, such as "light_samples: 4".
ImageF directLight(const State& state, const std::string& parameters, bool isFiltered = false, uint32_t width = 48,
                   uint32_t height = 27) {
    return Chain(state,
                 graphYaml({"gbuffer, samples_per_pixel_edge: 2", "direct_shadow_rays, " + parameters,
                            isFiltered ? "filter_irradiance, light: direct" : ""}),
                 width, height)
        .image("direct");
}

double meanSquaredError(const ImageF& image, const ImageF& truth) {
    double sum = 0;
    for (size_t i = 0; i < image.data.size(); ++i) sum += std::pow(double(image.data[i]) - double(truth.data[i]), 2);
    return sum / double(image.data.size());
}

TEST(EnvironmentCdf, OfAConstantMapIsThatOfSolidAngle) {
    const EnvironmentCdf cdf = environmentCdf({glm::vec3(3), std::make_shared<const ImageF>(8u, 4u, 3u, 1.0f)});
    ASSERT_EQ(cdf.rows.size(), 4u);
    ASSERT_EQ(cdf.columns.size(), 32u);
    for (uint32_t y = 0; y < 4; ++y) {
        EXPECT_NEAR(cdf.rows[y], 0.5 - 0.5 * std::cos(kPi * (y + 1) / 4), 1e-6);
        for (uint32_t x = 0; x < 8; ++x) EXPECT_NEAR(cdf.columns[8 * y + x], (x + 1) / 8.0, 1e-6);
    }
    EXPECT_NEAR(cdf.meanLuminance, 3, 1e-5);
}

TEST(EnvironmentCdf, ReachesAsFarAsABrightTexelIsInterpolated) {
    // Bilinear patches: 6/8 of a texel's own, 1/8 of either neighbor's. The map wraps horizontally.
    const auto map = std::make_shared<ImageF>(8, 4, 3);
    for (int c = 0; c < 3; ++c) map->pixel(0, 1)[c] = 5.0f;
    const EnvironmentCdf cdf = environmentCdf({glm::vec3(1), map});
    const double outer = 0.5 - 0.5 * std::cos(kPi / 4), inner = 0.5 - outer;  // Halves of the rows' solid angles
    const double total = outer + 6 * inner + inner;
    EXPECT_NEAR(cdf.rows[0], outer / total, 1e-6);
    EXPECT_NEAR(cdf.rows[1], (outer + 6 * inner) / total, 1e-6);
    EXPECT_EQ(cdf.rows[2], 1.0f);
    EXPECT_EQ(cdf.rows[3], 1.0f);
    const float* row = &cdf.columns[8];
    EXPECT_NEAR(row[0], 6.0 / 8, 1e-6);
    EXPECT_NEAR(row[1], 7.0 / 8, 1e-6);
    EXPECT_EQ(row[6], row[1]);
    EXPECT_EQ(row[7], 1.0f);
}

TEST(EnvironmentCdf, IsEmptyWithoutAMapAndForABlackOne) {
    EXPECT_EQ(environmentCdf({glm::vec3(2), nullptr}).width, 0u);
    const EnvironmentCdf black = environmentCdf({glm::vec3(2), std::make_shared<const ImageF>(8u, 4u, 3u)});
    EXPECT_EQ(black.width, 0u);
    EXPECT_EQ(black.meanLuminance, 0.0f);
}

/// A plane that reflects 0.5, under a map of radiance 3 cos(theta) above and 0 below: irradiance 2 pi, so radiance 1.
State planeUnderCosine() {
    const auto map = std::make_shared<ImageF>(64, 256, 3);
    for (uint32_t y = 0; y < 128; ++y)
        for (uint32_t x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) map->pixel(x, y)[c] = float(std::cos((y + 0.5) / 256 * kPi));
    const auto plane = withoutLights("plane", "{albedo: 0.5}");
    plane->environment = {glm::vec3(3), map};
    return evaluated(plane);
}

TEST(DirectLight, OfAMapOnAPlaneIsTheClosedForm) {
    for (const std::string candidates : {"1", "2", "3", "32"})
        EXPECT_NEAR(mean(directLight(planeUnderCosine(), "light_samples: 8, candidates: " + candidates, false, 16, 16)),
                    1, 3e-3)
            << candidates;
}

TEST(DirectLight, OfAMapInVoxelsIsTheClosedForm) {
    // Rays from the map, and shadow rays from surfels to it
    for (const std::string injection :
         {"inject_light_rays, rays_per_light: 262144", "inject_voxel_rays, light_samples: 4"})
        EXPECT_NEAR(mean(Chain(planeUnderCosine(),
                               graphYaml({"gbuffer", "voxelize, resolution: 16", "place_surfels",
                                          injection + ", bounces: 0", "gather_irradiance, light: direct", "composite"}))
                             .image("final")),
                    1, 0.02)
            << injection;
}

TEST(DirectLight, OfASunInAMapIsThatOfThePathTracer) {
    // Also in spots of shade: the mean difference is that of noise
    const State state = spheresUnder(sunAndSky());
    const auto final = [&](const std::vector<std::string>& passes) {
        return Chain(state, graphYaml(passes), 48, 27).image("final");
    };
    const ImageF expected = final({"path_trace, spp: 1024, bounces: 0"});
    const ImageF image =
        final({"gbuffer, samples_per_pixel_edge: 4", "direct_shadow_rays, light_samples: 8", "composite"});
    EXPECT_NEAR(mean(image) / mean(expected), 1, 5e-3);
    EXPECT_LT(meanDifference(image, expected), 0.06);
}

TEST(DirectLight, DoesNotDependOnCandidates) {
    // Few and many triangles, and more candidates than triangles; furnaces are 0.5 everywhere
    struct Case {
        State state;
        double expected;
    };
    const State glowing = glowingSpheres(), lamp = builtin("cornell", "{lights: area}");
    for (const Case& c : {Case{glowing, mean(directLight(glowing, "light_samples: 256, candidates: 1"))},
                          Case{lamp, mean(directLight(lamp, "light_samples: 64, candidates: 1"))}})
        for (const std::string candidates : {"2", "5", "32"})
            EXPECT_NEAR(mean(directLight(c.state, "light_samples: 16, candidates: " + candidates)) / c.expected, 1,
                        5e-3)
                << candidates;
    for (const std::string shape : {"sphere", "box"})
        EXPECT_NEAR(mean(directLight(builtin("furnace", "{albedo: 0.5, shape: " + shape + "}"), "light_samples: 16")),
                    0.5, 1e-3);
}

TEST(DirectLight, OfAFurnaceHasNoFirefliesInItsEdges) {
    // Texels up to the walls' edges, where the other wall brings half of the light
    for (const int seed : {1, 2, 3}) {
        const ImageF image = Chain(builtin("furnace", "{albedo: 0.5, shape: box}"),
                                   graphYaml({"gbuffer, samples_per_pixel_edge: 2, sample_pattern: rotated",
                                              "direct_shadow_rays, light_samples: 64"}),
                                   48, 27, uint64_t(seed))
                                 .image("direct");
        EXPECT_NEAR(mean(image), 0.5, 2e-3);
        EXPECT_LT(*std::ranges::max_element(image.data), 0.6f);
    }
}

TEST(DirectLight, IsLessNoisyWithCandidatesAndAgainWithTheFilter) {
    for (const bool isSky : {true, false}) {
        const State state = isSky ? spheresUnder(sunAndSky()) : glowingSpheres();
        const ImageF truth = directLight(state, "light_samples: 128, candidates: 8");
        const auto error = [&](const std::string& parameters, bool isFiltered = false) {
            return meanSquaredError(directLight(state, parameters, isFiltered), truth);
        };
        // The spheres' many triangles have the light tree in place of candidates
        if (isSky) {
            EXPECT_LT(error("light_samples: 4"), error("light_samples: 4, candidates: 1") / 4);
        }
        // One ray: more of them through the light tree are as near to the truth as the filter's blur
        EXPECT_LT(error("light_samples: 1", true), error("light_samples: 1") / 1.5);
    }
}

TEST(DirectLight, IsLinear) {
    const ImageF sky = directLight(spheresUnder(sunAndSky()), "light_samples: 2", true),
                 brightSky = directLight(spheresUnder(sunAndSky(), 16), "light_samples: 2", true),
                 lamps = directLight(glowingSpheres(), "light_samples: 2", true),
                 brightLamps = directLight(glowingSpheres(32), "light_samples: 2", true);
    for (size_t i = 0; i < sky.data.size(); ++i) {
        ASSERT_NEAR(brightSky.data[i], 16 * sky.data[i], 1e-3 * brightSky.data[i]);
        ASSERT_NEAR(brightLamps.data[i], 16 * lamps.data[i], 1e-3 * brightLamps.data[i]);
    }
}

TEST(DirectLight, IsTheSameInEachRun) {
    const State state = spheresUnder(sunAndSky());
    EXPECT_EQ(directLight(state, "light_samples: 2", true).data, directLight(state, "light_samples: 2", true).data);
}

TEST(DirectLight, FilteredIsTheUnfilteredOneOfManyRays) {
    const State state = builtin("cornell", "{lights: area}");
    const ImageF raw = directLight(state, "light_samples: 512"),
                 filtered = directLight(state, "light_samples: 512", true);
    EXPECT_NEAR(mean(filtered) / mean(raw), 1, 1e-3);
    EXPECT_LT(meanDifference(filtered, raw), 4e-3);
}

TEST(DirectLight, SplitsIntoIrradianceAndWhatIsNotFiltered) {
    // Glossy surfaces, a lamp, a sky and a point light: albedo / pi times the irradiance of texels is what 'direct' has
    // more than 'unfiltered_direct'.
    const auto scene = builtinScene("cornell", "{lights: area}");
    for (Material& material : scene->materials) {
        material.roughness = 0.5f;
        material.metallic = 0.25f;
        material.specular = 1;
    }
    scene->environment = {glm::vec3(1), sunAndSky()};
    Light& light = scene->lights.emplace_back();
    light.type = LightType::Point;
    light.intensity = glm::vec3(0.1f);
    Chain chain(evaluated(scene), graphYaml({"gbuffer, samples_per_pixel_edge: 1", "direct_shadow_rays"}), 24, 24);
    const ImageF direct = chain.image("direct"), unfiltered = chain.image("unfiltered_direct");
    const auto irradiance = chain.readImage<glm::vec4>(chain.get<NoisyIrradiance>("noisy_direct").irradiance);
    const auto albedo = chain.readImage<std::array<uint16_t, 4>>(chain.get<GBuffer>("gbuffer").albedo);
    double lobes = 0;
    for (size_t i = 0; i < direct.pixelCount(); ++i)
        for (size_t c = 0; c < 3; ++c) {
            const double diffuse = double(glm::unpackHalf1x16(albedo[i][c])) / kPi * double(irradiance[i][int(c)]);
            EXPECT_NEAR(direct.data[3 * i + c], unfiltered.data[3 * i + c] + diffuse, 1e-3 * direct.data[3 * i + c]);
            lobes += unfiltered.data[3 * i + c];
        }
    EXPECT_GT(lobes / double(direct.data.size()), 0.05 * mean(direct));
    EXPECT_LT(lobes / double(direct.data.size()), 0.9 * mean(direct));
}

TEST(DirectLight, FilteredKeepsPunctualLightsAsTheyAre) {
    const State state = builtin("cornell", "{lights: point}");
    EXPECT_EQ(directLight(state, "light_samples: 1", true).data, directLight(state, "light_samples: 1").data);
}

}  // namespace
}  // namespace voxray::test
