// Virtual point lights chosen by what they bring to the image: the same energy with less noise.
#include <gtest/gtest.h>

#include <numbers>

#include "passes/vpls/select_vpls/systematic_resampling.h"
#include "passes/vpls/vpls.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

std::string allLights(const std::string& paths) {
    return graphYaml({"gbuffer", "sample_vpls, vpls_per_bounce: " + paths, "gather_vpls, visibility: exact, block: 1"});
}

std::string selectedLights(const std::string& candidates, const std::string& count) {
    return graphYaml({"gbuffer", "sample_vpls, vpls_per_bounce: " + candidates, "select_vpls, count: " + count,
                      "gather_vpls, visibility: exact, block: 1"});
}

TEST(SelectVpls, ResamplingKeepsSumsOnAverage) {
    const std::vector<double> probabilities = {0.1, 0, 0.5, 0.05, 0.35};
    std::vector<double> means(5);
    for (int i = 0; i < 1000; ++i) {
        const Resampled kept = systematicResampling(probabilities, 3, (i + 0.5) / 1000);
        ASSERT_LE(kept.indices.size(), 3u);
        for (size_t k = 0; k < kept.indices.size(); ++k) means[kept.indices[k]] += kept.weights[k] / 1000;
    }
    for (const int place : {0, 2, 3, 4}) EXPECT_NEAR(means[size_t(place)], 1, 0.01) << place;
    EXPECT_EQ(means[1], 0);
    EXPECT_EQ(systematicResampling(probabilities, 3, 0.999999).indices.back(), 4u);
}

TEST(SelectVpls, BringTheEnergyOfAll) {
    // The camera sees half of the walls
    Chain chain("white_room", "{}", selectedLights("4096", "2048"), 16, 16);
    const Vpls& vpls = chain.get<Vpls>("vpls");
    const auto points = chain.read<gpu::Vpl>(vpls.points);
    const auto list = chain.read<uint32_t>(vpls.activeIndices);
    EXPECT_LE(vpls.activeCount, 2048u);
    EXPECT_GT(vpls.activeCount, 1024u);
    double flux = 0;
    for (uint32_t i = 0; i < vpls.activeCount; ++i) flux += points.at(list[i]).flux.y;
    const double each = 4 * std::numbers::pi * 0.8;
    EXPECT_NEAR(flux / (each + 0.8 * each + 0.64 * each), 1, 0.05);
    const double all = mean(Chain("white_room", "{}", allLights("4096"), 16, 16).image("indirect"));
    EXPECT_NEAR(mean(chain.image("indirect")) / all, 1, 0.02);
    // Whatever they are weighed by
    Chain weighed("white_room", "{}", selectedLights("4096", "2048, bound: 8"), 16, 16);
    EXPECT_NEAR(mean(weighed.image("indirect")) / all, 1, 0.02);
}

TEST(SelectVpls, MayBeSelectedAgain) {
    const double once = mean(Chain("white_room", "{}", selectedLights("16384", "2048"), 16, 16).image("indirect"));
    const std::string twice =
        graphYaml({"gbuffer", "sample_vpls, vpls_per_bounce: 16384", "select_vpls, id: first, count: 8192",
                   "select_vpls, count: 2048", "gather_vpls, visibility: exact, block: 1"});
    EXPECT_NEAR(mean(Chain("white_room", "{}", twice, 16, 16).image("indirect")) / once, 1, 0.03);
}

TEST(SelectVpls, BringOverManySeedsWhatManyLightsBring) {
    // 16 draws of 512 virtual lights, each with all that saves rays, against 262144 paths of light without
    // it; in squares of 8 pixels, whose means have a known error
    constexpr int kSeeds = 16, kSide = 32, kSquare = 8, kSquares = kSide / kSquare;
    const auto squares = [&](const std::string& graph, uint64_t seed) {
        const std::vector<float> pixels =
            Chain("cornell", "{lights: point}", graph, kSide, kSide, seed).image("indirect").data;
        std::vector<double> sums(kSquares * kSquares);
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                sums[size_t(y / kSquare * kSquares + x / kSquare)] += pixels[size_t(3 * (y * kSide + x) + 1)];
        return sums;
    };
    const std::string compensated = "gather_vpls, visibility: exact, compensation_rays: 2";
    const std::vector<double> right =
        squares(graphYaml({"gbuffer", "sample_vpls, vpls_per_bounce: 262144", compensated + ", block: 8"}), 99);
    std::vector<double> sums(right.size()), squared(right.size());
    for (int seed = 1; seed <= kSeeds; ++seed) {
        const std::vector<double> found =
            squares(graphYaml({"gbuffer", "sample_vpls, vpls_per_bounce: 4096", "select_vpls, count: 512",
                               compensated + ", roulette: 1, bound: 2"}),
                    uint64_t(seed));
        for (size_t i = 0; i < right.size(); ++i) sums[i] += found[i], squared[i] += found[i] * found[i];
    }
    double chiSquared = 0, total = 0, totalRight = 0;
    for (size_t i = 0; i < right.size(); ++i) {
        if (right[i] == 0) continue;
        const double mean = sums[i] / kSeeds;
        const double ofMean = (squared[i] / kSeeds - mean * mean) / (kSeeds - 1);
        chiSquared += (mean - right[i]) * (mean - right[i]) / ofMean;
        total += mean, totalRight += right[i];
    }
    std::printf("chi squared %.1f of %zu squares, ratio %.4f\n", chiSquared, right.size(), total / totalRight);
    // Around 1.2 were squares independent; they see the same virtual lights, so that it varies more
    EXPECT_LT(chiSquared / double(right.size()), 3);
    EXPECT_NEAR(total / totalRight, 1, 0.01);
}

TEST(SelectVpls, AreThoseThatTheCameraSees) {
    // A room whose light comes in through a window, and as many virtual lights with and without a choice
    const auto image = [](const std::string& graph) {
        return Chain("window_room", "{}", graph, 16, 16).image("indirect").data;
    };
    const std::vector<float> right = image(allLights("65536"));
    const auto error = [&](const std::string& graph) {
        const std::vector<float> found = image(graph);
        double sum = 0;
        for (size_t i = 0; i < right.size(); ++i) sum += (found[i] - right[i]) * (found[i] - right[i]);
        return sum;
    };
    EXPECT_LT(error(selectedLights("16384", "1024")), 0.5 * error(allLights("1024")));
}

}  // namespace
}  // namespace voxray::test
