// Screen probes against closed forms, gather rays of the same light, and themselves.
#include <gtest/gtest.h>

#include <cmath>

#include "image/metrics.h"
#include "passes/common/filter/noisy_irradiance.h"
#include "tests/gpu/chain.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

constexpr uint32_t kSize = 32;

/// Of a graph whose light is stored in voxels.
std::string probeGraph(const std::string& probes, const std::string& texels = "1") {
    return graphYaml({"gbuffer, samples_per_pixel_edge: " + texels, "voxelize, resolution: 16",
                      "inject_light_rays, rays_per_light: 131072, bounces: 2", "gather_screen_probes" + probes});
}

double reportedBy(const Chain& chain, const std::string& name) {
    for (const PassSample& sample : chain.frameSamples)
        for (const PassContext::Value& value : sample.reported)
            if (value.name == name) return value.value;
    throw Error("no value '{}' was reported", name);
}

/// Mean image of frames 1 to `count`.
ImageF meanOfFrames(Chain& chain, uint32_t count) {
    ImageF sum;
    for (uint32_t frame = 1; frame <= count; ++frame) {
        chain.runFrame(frame);
        const ImageF image = chain.image("indirect");
        if (sum.data.empty())
            sum = image;
        else
            for (size_t i = 0; i < sum.data.size(); ++i) sum.data[i] += image.data[i];
    }
    for (float& value : sum.data) value /= float(count);
    return sum;
}

/// The square of the nRMSE.
double squaredError(const ImageF& a, const ImageF& b) {
    return std::pow(nRmse(a, b), 2);
}

/// Gather rays of the same light, 4096 a pixel.
const ImageF& gathered(const std::string& scene, const std::string& parameters) {
    static std::map<std::string, ImageF> images;
    ImageF& image = images[scene + parameters];
    if (image.data.empty()) {
        Chain chain(scene, parameters,
                    graphYaml({"gbuffer, samples_per_pixel_edge: 2", "voxelize, resolution: 16",
                               "inject_light_rays, rays_per_light: 131072, bounces: 2",
                               "trace_gather_rays, rays_per_block: 1024", "gather_rays"}),
                    kSize, kSize);
        image = chain.image("indirect");
    }
    return image;
}

TEST(ScreenProbes, KeepTheEnergyOfAFurnace) {
    // After two bounces of stored light and that of the gather: 0.36 + 0.216 + 0.1296
    for (const std::string probes :
         {", importance: 0, filter_passes: 0, extra_probes: 0", ", importance: 0", "", ", importance: 0.9, spacing: 2"})
        for (const std::string shape : {"box", "sphere"}) {
            Chain chain("furnace", "{shape: " + shape + ", albedo: 0.6, emission: 1}", probeGraph(probes), kSize,
                        kSize);
            const double ratio = mean(meanOfFrames(chain, 24)) / 0.7056;
            std::printf("%s, %s: %.4f of the closed form\n", probes.c_str(), shape.c_str(), ratio);
            EXPECT_NEAR(ratio, 1, 0.01) << probes << ", " << shape;
        }
}

TEST(ScreenProbes, ConvergeToGatherRaysAsTheyBecomeMore) {
    // Errors of single images, whose noise falls with the number of rays, and whose blur falls with the spacing
    const ImageF& truth = gathered("cornell", "{lights: area}");
    double before = 1e9, ratio = 0;
    for (const std::string knobs : {"spacing: 8, rays_per_probe: 16", "spacing: 4, rays_per_probe: 64",
                                    "spacing: 2, rays_per_probe: 256", "spacing: 1, rays_per_probe: 512"}) {
        Chain chain("cornell", "{lights: area}", probeGraph(", filter_passes: 0, importance: 0, " + knobs, "2"), kSize,
                    kSize);
        const ImageF image = meanOfFrames(chain, 2);
        const double error = squaredError(image, truth);
        ratio = mean(image) / mean(truth);
        std::printf("%s: squared nRMSE %.5f, mean ratio %.4f, %.2f probes a tile, %.2f %% without\n", knobs.c_str(),
                    error, ratio, reportedBy(chain, "probes per tile"),
                    reportedBy(chain, "texels without a probe of their surface, %"));
        EXPECT_LT(error, before);
        before = error;
    }
    EXPECT_NEAR(ratio, 1, 0.01);
    EXPECT_LT(before, 0.0015);
}

TEST(ScreenProbes, TheFilterLowersNoiseAndKeepsTheMean) {
    const ImageF& truth = gathered("cornell", "{lights: area}");
    double before = 1e9;
    for (const std::string passes : {"0", "1", "3"}) {
        Chain chain("cornell", "{lights: area}",
                    probeGraph(", spacing: 1, rays_per_probe: 16, filter_passes: " + passes, "2"), kSize, kSize);
        double error = 0, ratio = 0;
        for (uint32_t frame = 1; frame <= 8; ++frame) {
            chain.runFrame(frame);
            error += squaredError(chain.image("indirect"), truth) / 8;
            ratio += mean(chain.image("indirect")) / mean(truth) / 8;
        }
        std::printf("%s passes: squared nRMSE %.5f, mean ratio %.4f\n", passes.c_str(), error, ratio);
        EXPECT_LT(error, before);
        EXPECT_NEAR(ratio, 1, 0.01);
        before = error;
    }
}

/// Of frames: the mean of their sums over all texels, the variance of that mean, and the sum of texels' variances.
struct Totals {
    double mean = 0, meanSquare = 0, variance = 0, texelVariance = 0;
};

TEST(ScreenProbes, ImportanceLeavesTheMeanAndLowersNoise) {
    // A lamp shines into a narrow cone, and light is reflected once: all comes from one place. A tile is a pixel, so
    // that probes stand still.
    const auto run = [](const std::string& importance) {
        Chain chain(roomWithSpot(10),
                    graphYaml({"gbuffer, samples_per_pixel_edge: 1", "voxelize", "inject_light_rays, bounces: 0",
                               "gather_screen_probes, near_field_cells: 0, filter_passes: 1, spacing: 1, "
                               "rays_per_probe: 32, importance: " +
                                   importance}),
                    kSize, kSize);
        chain.runFrames(8);
        std::vector<double> sums(kSize * kSize), squares(kSize * kSize);
        const uint32_t frames = 48;
        Totals totals;
        for (uint32_t frame = 9; frame < 9 + frames; ++frame) {
            chain.runFrame(frame);
            const ImageF image = chain.image("indirect");
            double total = 0;
            for (size_t i = 0; i < sums.size(); ++i) {
                const double value = image.data[3 * i];
                sums[i] += value;
                squares[i] += value * value;
                total += value;
            }
            totals.mean += total / frames;
            totals.meanSquare += total * total / frames;
        }
        for (size_t i = 0; i < sums.size(); ++i)
            totals.texelVariance += squares[i] / frames - std::pow(sums[i] / frames, 2);
        totals.variance = (totals.meanSquare - totals.mean * totals.mean) / (frames - 1);
        return totals;
    };
    const Totals plain = run("0"), guided = run("0.5");
    const double z = (guided.mean - plain.mean) / std::sqrt(plain.variance + guided.variance);
    std::printf("mean ratio %.4f, z %.2f, variance ratio %.3f\n", guided.mean / plain.mean, z,
                guided.texelVariance / plain.texelVariance);
    EXPECT_LT(std::abs(z), 4);
    EXPECT_NEAR(guided.mean / plain.mean, 1, 0.02);
    EXPECT_LT(guided.texelVariance, 0.3 * plain.texelVariance);
}

TEST(ScreenProbes, ExtraProbesStandWhereDepthBreaks) {
    const ImageF& truth = gathered("clutter", "{}");
    const auto run = [&](const std::string& extra) {
        Chain chain("clutter", "{}", probeGraph(", importance: 0, rays_per_probe: 256, extra_probes: " + extra, "2"),
                    kSize, kSize);
        const double uncovered = reportedBy(chain, "texels without a probe of their surface, %");
        const double error = squaredError(meanOfFrames(chain, 2), truth);
        std::printf("%s: %.2f probes a tile, %.2f %% of texels without, squared nRMSE %.5f\n", extra.c_str(),
                    reportedBy(chain, "probes per tile"), uncovered, error);
        return std::pair(uncovered, error);
    };
    const auto [without, errorWithout] = run("0");
    const auto [with, errorWith] = run("8");
    EXPECT_GT(without, 1.0);
    EXPECT_LT(with, 0.25 * without);
    EXPECT_LT(errorWith, 0.8 * errorWithout);
}

TEST(ScreenProbes, MayHaveMoreBinsThanABufferBinds) {
    // 35,328 probes of 256 bins take 138 MiB, where software Vulkan binds 128 MiB at most
    constexpr uint32_t kWidth = 192, kHeight = 184, kRows = 16;
    Chain chain("furnace", "{shape: box, albedo: 0.6, emission: 1}",
                probeGraph(", spacing: 1, extra_probes: 0, directions: 16, rays_per_probe: 2, filter_passes: 1"),
                kWidth, kHeight);
    chain.runFrames(2);
    const ImageF image = chain.image("indirect");
    for (const uint32_t first : {0u, kHeight - kRows}) {
        double sum = 0;
        for (uint32_t y = first; y < first + kRows; ++y)
            for (uint32_t x = 0; x < kWidth; ++x) sum += double(image.pixel(x, y)[1]);
        EXPECT_NEAR(sum / (kRows * kWidth) / 0.7056, 1, 0.02) << first;
    }
}

TEST(ScreenProbes, LeaveASealedRoomBlack) {
    // Its floor and ceiling run on outside into the sun
    for (const auto& [light, source] : {std::pair("voxelize", "voxels"), std::pair("", "radiance_cache")}) {
        Chain chain("shell_room", "{}",
                    graphYaml({"gbuffer", light, *light ? "inject_light_rays" : "update_radiance_cache",
                               std::string("gather_screen_probes, spacing: 4, source: ") + source}),
                    kSize, kSize);
        EXPECT_EQ(mean(meanOfFrames(chain, 3)), 0.0) << source;
    }
}

TEST(ScreenProbes, AMovingCameraLeavesTheMeanAsItIs) {
    const glm::vec3 step(0.05f, 0.03f, -0.04f);
    const auto run = [&](const std::string& importance) {
        Chain chain("cornell", "{lights: area}", probeGraph(", importance: " + importance), kSize, kSize);
        const glm::vec3 start = chain.state().cameras.at(0).position;
        double sum = 0;
        for (uint32_t frame = 1; frame <= 240; ++frame) {
            chain.runFrameFrom(start + step * float((frame + 5) % 6), frame);
            if (frame % 6 == 0) sum += mean(chain.image("indirect"));
        }
        return sum;
    };
    EXPECT_NEAR(run("0.5") / run("0"), 1, 0.01);
}

TEST(ScreenProbes, AreLinearInLightAndDeterministic) {
    const auto run = [](const std::string& intensity) {
        Chain chain("white_room", "{intensity: " + intensity + "}", probeGraph(""), 16, 16);
        chain.runFrames(3);
        return chain.readImage<glm::vec4>(chain.get<NoisyIrradiance>("noisy_irradiance").irradiance);
    };
    const auto one = run("1"), seven = run("7");
    EXPECT_TRUE(sameBits(one, run("1")));
    double sum = 0, sevenfold = 0;
    for (size_t i = 0; i < one.size(); ++i) sum += one[i].g, sevenfold += seven[i].g;
    EXPECT_NEAR(sevenfold / sum, 7, 7e-3);
}

TEST(ScreenProbes, ReadARadianceCache) {
    // 1 W/sr in the center of a sphere of 1 m give 1 W/m², and each bounce reflects 0.6 of that to everywhere
    Chain chain(litSphere(),
                graphYaml({"gbuffer", "update_radiance_cache, rays_per_image: 65536, bounces: 3",
                           "gather_screen_probes, source: radiance_cache"}),
                kSize, kSize);
    const double ratio = mean(meanOfFrames(chain, 16)) / (0.6 / kPi * (0.6 + 0.36 + 0.216 + 0.1296));
    std::printf("%.4f of the closed form\n", ratio);
    EXPECT_NEAR(ratio, 1, 0.01);
}

TEST(ScreenProbes, RefuseWhatTheyCannotDo) {
    const auto message = [](const std::string& probes) {
        return errorOf([&] { Chain("cornell", "{}", probeGraph(probes)); });
    };
    EXPECT_CONTAINS(message(", spacing: 3"), "spacing");
    EXPECT_CONTAINS(message(", rays_per_probe: 0"), "out of range");
}

}  // namespace
}  // namespace voxray::test
