// The irradiance filter: what it must keep, how far it may be off, and every source that it can follow.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "known_irradiance.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

ImageF filterKnown(const std::string& source, const std::string& filter, const std::string& scene,
                   const std::string& samples = "1") {
    Chain chain(scene, scene == "white_room" ? "{albedo: 0.5}" : "{}",
                "[{pass: gbuffer, samples_per_pixel_edge: " + samples + "}, {pass: known_irradiance, " + source +
                    "}, {pass: filter_irradiance, " + filter + "}]",
                48, 48, 1, [](Registry& registry) { registry.add<KnownIrradiance>(); });
    return chain.image("indirect");
}

/// What every value of `estimator` must keep.
class FilterEstimator : public ::testing::TestWithParam<std::string> {
 protected:
    /// @return a filter's parameters, with the estimator.
    static std::string with(const std::string& parameters) { return "estimator: " + GetParam() + ", " + parameters; }
};
INSTANTIATE_TEST_SUITE_P(FilterIrradiance, FilterEstimator, ::testing::Values("mean", "regression"),
                         [](const auto& info) { return info.param; });

TEST_P(FilterEstimator, KeepsConstantIrradianceExactly) {
    // Cornell's edges, walls of different albedo, background and sub-pixels; a mean of equal values is that
    // value, however taps are weighted and wherever rays are missing.
    const ImageF one = filterKnown("rays: 1", with("levels: 1"), "cornell", "2");
    EXPECT_GT(mean(one), 0.0);
    EXPECT_EQ(filterKnown("rays: 1", with("levels: 5"), "cornell", "2").data, one.data);
    EXPECT_EQ(filterKnown("rays: 1, spacing: 4", with("levels: 5"), "cornell", "2").data, one.data);
    EXPECT_EQ(filterKnown("rays: 16", with("levels: 3, edge_stopping_scale: 10"), "cornell", "2").data, one.data);
}

TEST(FilterIrradiance, MultipliesByAlbedoOverPi) {
    // The g-buffer keeps albedo in half floats, cut off at 11 bits.
    const double expected = 0.5 * 2 / kPi;
    for (const float value : filterKnown("rays: 1", "levels: 4", "white_room").data)
        EXPECT_NEAR(value, expected, expected * 0x1p-10);
}

TEST_P(FilterEstimator, KeepsTheMeanOfNoise) {
    // Weights depend on geometry and on the number of rays alone, so the filter has no bias: the mean over N
    // texels is off by their noise, sigma, times the root of the sum of their squared weights in that mean.
    // Where the image's edge cuts the kernel off, weights at most double along each axis: 4 / N at most, so
    // the root is 2 / sqrt(N) at most. Even noise of +-1 has sigma 1 / sqrt(3).
    const ImageF noisy = filterKnown("noise: 1", with("levels: 4"), "white_room");
    const double sigma = 1 / std::sqrt(3.0), texels = 48 * 48;
    EXPECT_NEAR(mean(noisy) / (0.5 * 2 / kPi), 1, 4 * sigma * 2 / std::sqrt(texels));

    // And it is much smoother.
    double squares = 0;
    for (const float value : noisy.data) squares += std::pow(value / mean(noisy) - 1, 2);
    EXPECT_LT(std::sqrt(squares / double(noisy.data.size())), 0.2 * sigma);
}

TEST_P(FilterEstimator, FiltersLightOfEarlierFramesWhereThisFramesRaysAreBlack) {
    // After `accumulate` texels hold light of frames of which the moments know nothing. The bound is that of
    // KeepsTheMeanOfNoise
    const ImageF noisy = filterKnown("noise: 1, moments: true, black: true", with("levels: 4"), "white_room");
    double squares = 0;
    for (const float value : noisy.data) squares += std::pow(value / mean(noisy) - 1, 2);
    EXPECT_LT(std::sqrt(squares / double(noisy.data.size())), 0.2 / std::sqrt(3.0));
}

TEST_P(FilterEstimator, LeavesWellKnownIrradianceAlone) {
    const ImageF noisy = filterKnown("noise: 1, rays: 1e9", with("levels: 1, edge_stopping_scale: 100"), "white_room");
    const ImageF filtered = filterKnown("noise: 1, rays: 1e9", with("levels: 4"), "white_room");
    EXPECT_LT(meanDifference(filtered, noisy), 1e-3);
}

TEST_P(FilterEstimator, LeavesEverySurfaceOfAPixelItsOwn) {
    // Also where the second surface is a 9th or a 16th of the pixel
    for (const std::string samples : {"2", "3", "4"}) {
        SCOPED_TRACE(samples);
        const std::string source = "step: 100, noise: 1, rays: 1e9", filter = ", edge_stopping_scale: 100";
        const ImageF one = filterKnown(source, with("levels: 1") + filter, "cornell", samples);
        const ImageF four = filterKnown(source, with("levels: 4") + filter, "cornell", samples);
        double largest = 0;
        for (size_t i = 0; i < one.data.size(); ++i)
            if (one.data[i] > 0) largest = std::max(largest, std::abs(four.data[i] / double(one.data[i]) - 1));
        EXPECT_LT(largest, 0.01);
    }
}

TEST_P(FilterEstimator, IsTheSameOverMaterialsOfSurfaces) {
    // The room's walls are flat and of one color each. Cornell's camera is no test of it: rays right through the room's
    // edges hit either of two walls, by the order of rays
    const std::string source = "step: 10, noise: 1, moments: true";
    const ImageF each = filterKnown(source, with("levels: 4"), "window_room", "2");
    const ImageF shared = filterKnown(source, with("levels: 4"), "window_room", "2, materials_of: surfaces");
    EXPECT_LT(meanDifference(shared, each), 1e-4);
}

TEST_P(FilterEstimator, KeepsALinearGradientOnAWall) {
    // A mean over a symmetric kernel keeps what is linear. The reach of 7 texels stays on the wall.
    const ImageF filtered = filterKnown("slope: 0.5", with("levels: 3"), "white_room");
    for (uint32_t x = 16; x < 32; ++x) {
        const double at = (x + 0.5) / 48 - 0.5;
        EXPECT_NEAR(filtered.pixel(x, 24)[1] / (0.5 * 2 / kPi), 1 + 0.5 * at, 2e-3) << x;
    }
}

TEST_P(FilterEstimator, KeepsALinearGradientOfNoisyRays) {
    // The same with what the filter knows of rays, whose variance is 1/12 of their squared mean: means of
    // surroundings differ by less than the weights can tell from noise.
    const ImageF filtered =
        filterKnown("slope: 0.2, noise: 0.5, moments: true, stratified: true", with("levels: 3"), "white_room");
    for (uint32_t x = 16; x < 32; ++x) {
        const double at = (x + 0.5) / 48 - 0.5;
        EXPECT_NEAR(filtered.pixel(x, 24)[1] / (0.5 * 2 / kPi), 1 + 0.2 * at, 2e-3) << x;
    }
}

TEST_P(FilterEstimator, IsLinearInLight) {
    const std::string source = "noise: 1, step: 4, moments: true";
    const ImageF one = filterKnown(source, with("levels: 4"), "cornell"),
                 scaled = filterKnown(source + ", scale: 1024", with("levels: 4"), "cornell");
    for (size_t i = 0; i < one.data.size(); ++i)
        EXPECT_NEAR(scaled.data[i], 1024 * one.data[i], 1e-3 * 1024 * one.data[i]);
}

TEST_P(FilterEstimator, SeesAnEdgeOfLightThatGeometryDoesNotTell) {
    // Half of the wall has 16 times the light of the other. The means of surroundings tell the two apart, so
    // that the dark half stays dark up to the reach of these means.
    const std::string source = "noise: 1, step: 16";
    const ImageF blind = filterKnown(source, with("levels: 5"), "white_room"),
                 seeing = filterKnown(source + ", moments: true", with("levels: 5"), "white_room");
    const auto dark = [](const ImageF& image) {
        double sum = 0;
        for (uint32_t y = 16; y < 32; ++y)
            for (uint32_t x = 12; x < 20; ++x) sum += image.pixel(x, y)[1] / (0.5 * 2 / kPi);
        return sum / (16 * 8);
    };
    EXPECT_GT(dark(blind), 1.5);
    EXPECT_NEAR(dark(seeing), 1, 0.3);
}

TEST(FilterIrradiance, RegressionMeasuresTheNoiseOfStratifiedRays) {
    // Half of the wall has 1.15 times the light of the other. Rays of both images have a standard deviation of 58 %.
    // Where texels have it too, the filter takes the step for noise; where rays are stratified, so that texels have
    // none, it keeps the step.
    const auto step = [](const std::string& noise) {
        const ImageF image =
            filterKnown("noise: 1, step: 1.15, moments: true" + noise, "estimator: regression", "white_room");
        double dark = 0, bright = 0;
        for (uint32_t y = 8; y < 40; ++y)
            for (uint32_t x = 0; x < 4; ++x) {
                dark += image.pixel(20 + x, y)[1];
                bright += image.pixel(24 + x, y)[1];
            }
        return bright / dark - 1;
    };
    EXPECT_LT(step(""), 0.08);
    EXPECT_GT(step(", stratified: true"), 0.12);
}

TEST_P(FilterEstimator, KeepsTheEnergyOfRareRays) {
    // Few rays bring all light. Elements around them have noise and take many taps, all others few: without light that
    // is kept, one ray in 400 would bring ONEIN times its own.
    for (const std::string oneIn : {"16", "400"}) {
        const std::string source = "one_in: " + oneIn + ", noise: 0, moments: true";
        const ImageF raw = filterKnown(source, "levels: 1, edge_stopping_scale: 100", "white_room"),
                     filtered = filterKnown(source, with("levels: 5"), "white_room");
        EXPECT_NEAR(mean(filtered) / mean(raw), 1, 0.02) << oneIn;
    }
}

TEST(FilterIrradiance, RegressionBoundsOutliersAndGivesBackWhatTheyLose) {
    // One texel of the wall has a thousand times the light. Of that, the bound by its surroundings leaves a
    // quarter there, and brings the rest back all over the wall.
    const std::string source = "noise: 1, firefly: 1000",
                      filter = "estimator: regression, levels: 1, edge_stopping_scale: 100";
    const ImageF raw = filterKnown(source, filter, "white_room"),
                 bounded = filterKnown(source + ", moments: true", filter, "white_room");
    const auto corner = [](const ImageF& image) {
        double sum = 0;
        for (uint32_t y = 0; y < 12; ++y)
            for (uint32_t x = 0; x < 12; ++x) sum += image.pixel(x, y)[1];
        return sum;
    };
    EXPECT_NEAR(mean(bounded) / mean(raw), 1, 0.05);
    EXPECT_GT(corner(bounded), 1.1 * corner(raw));
}

TEST(FilterIrradiance, NamesGapsThatItCannotFill) {
    EXPECT_ERROR("'levels' to 4", filterKnown("spacing: 8", "levels: 2", "cornell"));
}

const std::string kPaths = "{pass: path_trace, light: indirect, ";
/// @return the end of a graph: the filter by an estimator, and the image.
std::string filterBy(const std::string& estimator) {
    return ", {pass: filter_irradiance, estimator: " + estimator + "}, {pass: composite}]";
}

TEST(FilterIrradiance, PathsIrradianceTimesAlbedoIsTheirRadiance) {
    // One albedo everywhere: a pixel's indirect light is albedo / pi times the mean irradiance of its texels,
    // by their numbers of paths.
    Chain chain("white_room", "{albedo: 0.5}",
                "[{pass: gbuffer, samples_per_pixel_edge: 2}, " + kPaths + "spp: 16}, " + "{pass: composite}]");
    const ImageF indirect = chain.image("indirect");
    const NoisyIrradiance& noisy = chain.get<NoisyIrradiance>("noisy_irradiance");
    const std::vector<glm::vec4> texels = chain.readImage<glm::vec4>(noisy.irradiance);
    for (uint32_t y = 0; y < indirect.height; ++y)
        for (uint32_t x = 0; x < indirect.width; ++x) {
            glm::vec4 sum(0.0f);
            for (uint32_t t = 0; t < 4; ++t) {
                const glm::vec4 texel = texels[(2 * y + t / 2) * 2 * indirect.width + 2 * x + t % 2];
                sum += glm::vec4(glm::vec3(texel) * texel.w, texel.w);
            }
            EXPECT_EQ(sum.w, 16.0f);
            EXPECT_NEAR(sum.g / 16 * 0.5 / kPi, indirect.pixel(x, y)[1], 1e-5 * mean(indirect));
        }

    // Each block of moments has seen each of its paths once.
    const std::vector<gpu::RayMoments> moments = chain.read<gpu::RayMoments>(noisy.moments);
    double rays = 0, luminance = 0, irradiance = 0;
    for (const gpu::RayMoments& m : moments) {
        rays += m.rays;
        luminance += m.luminance;
        EXPECT_GE(m.rays * m.squared, 0.999f * m.luminance * m.luminance);
    }
    for (const glm::vec4& texel : texels) irradiance += double(texel.g) * texel.w;
    EXPECT_EQ(rays, 16.0 * double(indirect.pixelCount()));
    EXPECT_NEAR(luminance / irradiance, 1, 1e-4);  // The room is grey.
}

TEST(FilterIrradiance, PathsWithoutDirectLightAreTheSamePaths) {
    const auto trace = [](const std::string& light) {
        return std::make_unique<Chain>(
            "cornell", "{}",
            "[{pass: gbuffer}, {pass: path_trace, spp: 4, bounces: 3, light: " + light + "}, {pass: composite}]");
    };
    const auto all = trace("all"), indirect = trace("indirect");
    EXPECT_EQ(indirect->image("indirect").data, all->image("indirect").data);
    EXPECT_LT(indirect->frameSamples.at(1).rays, all->frameSamples.at(1).rays);
    EXPECT_THROW(Chain("cornell", "{}", "[{pass: path_trace, light: indirect}]"), Error);
}

/// A wall whose left half reflects 0.2 and whose right half 0.8.
State wallOfTwoColors() {
    SceneBuilder builder("wall");
    for (const float albedo : {0.2f, 0.8f}) {
        Material m;
        m.baseColor = glm::vec4(glm::vec3(albedo), 1.0f);
        m.metallic = m.specular = 0;
        builder.quad("half", {albedo < 0.5f ? -2 : 0, -2, 0}, {2, 0, 0}, {0, 4, 0}, builder.material(m));
    }
    builder.camera({0, 0, 1}, {0, 0, 0}, 60);
    return evaluated(builder.finish());
}

TEST_P(FilterEstimator, KeepsLightThatChangesWithAlbedo) {
    // The right half has four times the light, too. Nothing tells the filter of that: in the limit of a wide one pixels
    // would reflect the mean albedo of 0.5 times the mean irradiance of 5, and not 3.4; with 5 levels they had 0.95 of
    // it. Tiles reflect what their rays do, up to how these factors change over the three tiles of the image.
    const auto ratio = [](const std::string& samples, const std::string& source) {
        const auto image = [&](const std::string& filter) {
            Chain chain(wallOfTwoColors(),
                        "[{pass: gbuffer, samples_per_pixel_edge: " + samples +
                            "}, {pass: known_irradiance, step: 4, " + source + "}, {pass: filter_irradiance, " +
                            filter + "}]",
                        48, 48, 1, [](Registry& registry) { registry.add<KnownIrradiance>(); });
            return mean(chain.image("indirect"));
        };
        return image(with("levels: 5")) / (3.4 / kPi);
    };
    for (const std::string samples : {"1", "2"}) {
        EXPECT_NEAR(ratio(samples, "rays: 1"), 1, 0.02) << samples;
        EXPECT_NEAR(ratio(samples, "rays: 1, noise: 0.5, spacing: 2, moments: true"), 1, 0.03) << samples;
    }
}

TEST_P(FilterEstimator, KeepsTheEnergyOfAPathTracedFurnace) {
    // Every surface emits 1 and reflects 0.6. Two bounces after direct light: 0.36 + 0.216. The raw image's
    // own variance bounds the error, as in KeepsTheMeanOfNoise. In a sphere most pixels show several facets.
    const std::array<std::array<std::string, 2>, 4> cases{
        {{"box", "1"}, {"box", "2"}, {"box", "2, materials_of: surfaces"}, {"sphere", "2, materials_of: surfaces"}}};
    for (const auto& [shape, samples] : cases) {
        Chain chain("furnace", "{shape: " + shape + ", albedo: 0.6, emission: 1}",
                    "[{pass: gbuffer, samples_per_pixel_edge: " + samples + "}, " + kPaths + "spp: 4, bounces: 2}" +
                        filterBy(GetParam()),
                    48, 48);
        const ImageF a = chain.image("indirect_a"), b = chain.image("indirect_b");
        double squares = 0;
        for (size_t i = 0; i < a.data.size(); ++i) squares += std::pow(0.5 * (a.data[i] - b.data[i]), 2);
        const double variance = squares / double(a.data.size());
        const double noise = std::sqrt(variance / double(a.pixelCount()));
        EXPECT_LT(8 * noise, 0.02);
        EXPECT_NEAR(mean(chain.image("indirect")), 0.576, 8 * noise) << shape << ", " << samples;
    }
}

TEST_P(FilterEstimator, FollowsAnySource) {
    // The same scene by gather rays and by paths: the same light, and less noise than without the filter.
    const ImageF& expected = pathTraced("cornell", "{lights: point}", 256, 4, 64, 64);
    const auto image = [](const std::string& source, const std::string& end) {
        return Chain("cornell", "{lights: point}",
                     "[{pass: gbuffer, samples_per_pixel_edge: 2}, {pass: voxelize, resolution: 48}, {pass: "
                     "inject_light_rays, rays_per_light: 131072, bounces: 3}, {pass: "
                     "trace_gather_rays, rays_per_block: 4}, " +
                         source + end,
                     64, 64)
            .image("indirect");
    };
    for (const std::string& source : {std::string("{pass: gather_rays}"), kPaths + "spp: 4, bounces: 4}"}) {
        const ImageF raw = image(source, ", {pass: composite}]"), filtered = image(source, filterBy(GetParam()));
        EXPECT_NEAR(mean(filtered) / mean(expected), 1, 0.03) << source;
        EXPECT_LT(meanDifference(filtered, expected), 0.5 * meanDifference(raw, expected)) << source;
    }
}

}  // namespace
}  // namespace voxray::test
