#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "base/error.h"
#include "image/score.h"

/// Errors against a reference that is two noisy halves, where the true image is known.
namespace voxray {
namespace {

constexpr uint32_t kWidth = 64, kHeight = 48;

/// A smooth image between 0.2 and 1.8, whose mean is 1.
ImageF truth() {
    ImageF image(kWidth, kHeight, 3);
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x)
            for (uint32_t c = 0; c < 3; ++c)
                image.pixel(x, y)[c] =
                    float(1 + 0.8 * std::sin(2 * M_PI * x / kWidth) * std::cos(2 * M_PI * y / kHeight));
    return image;
}

/// An image whose values are gamma distributed about another's, as those of paths: not negative, skewed.
/// @param deviation standard deviation over the mean.
ImageF noisy(const ImageF& mean, double deviation, std::mt19937& random) {
    std::gamma_distribution<double> factor(1 / (deviation * deviation), deviation * deviation);
    ImageF image = mean;
    for (float& value : image.data) value = float(value * factor(random));
    return image;
}

ImageF scaled(ImageF image, float factor) {
    for (float& value : image.data) value *= factor;
    return image;
}

ImageF meanOf(const ImageF& a, const ImageF& b) {
    ImageF mean = a;
    for (size_t i = 0; i < mean.data.size(); ++i) mean.data[i] = 0.5f * (a.data[i] + b.data[i]);
    return mean;
}

using PlainMetric = double (*)(const ImageF&, const ImageF&, PixelMask);
using FreedMetric = Estimate (*)(const ImageF&, const ReferenceHalves&, PixelMask);

/// What many references of a noise say of an image, next to what is true.
struct Simulation {
    double truth = 0, plain = 0,
           freed = 0;    ///< Means over references; of `freed` that of what it is before a root.
    double covered = 0;  ///< Part of the intervals that hold the truth.
};
Simulation simulate(PlainMetric plain, FreedMetric freed, double power, const ImageF& test, double deviation) {
    constexpr int kReferences = 400;
    std::mt19937 random(3);
    const ImageF right = truth();
    Simulation s;
    s.truth = plain(test, right, {});
    for (int i = 0; i < kReferences; ++i) {
        const ImageF a = noisy(right, deviation, random), b = noisy(right, deviation, random);
        const Estimate estimate = freed(test, {a, b}, {});
        s.plain += std::pow(plain(test, meanOf(a, b), {}), power) / kReferences;
        s.freed += std::pow(estimate.value, power) / kReferences;
        s.covered += double(estimate.interval->low <= s.truth && s.truth <= estimate.interval->high) / kReferences;
    }
    s.truth = std::pow(s.truth, power);
    std::printf("truth %.5f plain %.5f freed %.5f covered %.3f\n", s.truth, s.plain, s.freed, s.covered);
    return s;
}

TEST(Unbiased, NrmseIsRightAtFewSamplesWhereThePlainOneIsNot) {
    // An error of 20 %, halves with a noise of 60 %: the plain mean square has that of their mean, 0.18, on
    // top.
    const Simulation s = simulate(nRmse, nRmse, 2, scaled(truth(), 1.2f), 0.6);
    EXPECT_GT(s.plain, 4 * s.truth);
    EXPECT_NEAR(s.freed / s.truth, 1, 0.02);
    EXPECT_NEAR(s.covered, 0.95, 0.03);
}

TEST(Unbiased, RelMseIsRightAtFewSamplesWhereThePlainOneIsNot) {
    const Simulation s = simulate(relMse, relMse, 1, scaled(truth(), 1.2f), 0.3);
    EXPECT_GT(s.plain, 2 * s.truth);
    EXPECT_NEAR(s.freed / s.truth, 1, 0.05);
    EXPECT_GT(s.covered, 0.93);

    // Noise of 60 %, which first order does not describe: the interval tells.
    EXPECT_GT(simulate(relMse, relMse, 1, scaled(truth(), 1.2f), 0.6).covered, 0.9);
}

TEST(Unbiased, NoiseOfTheImageIsItsError) {
    std::mt19937 random(11);
    const Simulation s = simulate(nRmse, nRmse, 2, noisy(truth(), 0.5, random), 0.3);
    EXPECT_NEAR(s.freed / s.truth, 1, 0.02);
    // Most of the interval is the spread of the image's own noise, which stays.
    EXPECT_GT(s.covered, 0.95);
}

TEST(Unbiased, PerfectImageHasAnIntervalThatBeginsAtZero) {
    std::mt19937 random(5);
    const ImageF right = truth();
    int atZero = 0;
    for (int i = 0; i < 200; ++i) {
        const ImageF a = noisy(right, 0.5, random), b = noisy(right, 0.5, random);
        const Estimate nrmse = nRmse(right, {a, b}), relmse = relMse(right, {a, b});
        EXPECT_GE(nrmse.value, 0);
        EXPECT_GE(relmse.value, 0);
        EXPECT_LT(nrmse.interval->high, 0.15);  // The plain one is 0.35.
        atZero += nrmse.interval->low == 0;
    }
    EXPECT_GE(atZero, 190);
}

TEST(Unbiased, WithoutNoiseItIsThePlainMetric) {
    const ImageF right = truth(), test = scaled(right, 1.3f);
    const ReferenceHalves halves{right, right};
    EXPECT_NEAR(nRmse(test, halves).value, nRmse(test, right), 1e-12);
    EXPECT_NEAR(relMse(test, halves).value, relMse(test, right), 1e-12);

    // In units of the mean, whatever the light's strength
    const ImageF bright = scaled(right, 1024), brightTest = scaled(test, 1024);
    EXPECT_NEAR(nRmse(brightTest, {bright, bright}).value, nRmse(test, right), 1e-9);

    // A constant error is certain
    const ImageF flat(kWidth, kHeight, 3, 2.0f), higher(kWidth, kHeight, 3, 3.0f);
    const Estimate certain = nRmse(higher, {flat, flat});
    EXPECT_NEAR(certain.value, 0.5, 1e-12);
    EXPECT_NEAR(certain.interval->low, 0.5, 1e-12);
    EXPECT_NEAR(certain.interval->high, 0.5, 1e-12);
}

TEST(Unbiased, MasksSelectPixelsAndTheirTiles) {
    ImageF reference(kWidth, kHeight, 3, 1.0f), test(kWidth, kHeight, 3, 9.0f);
    std::vector<uint8_t> left(test.pixelCount()), single(test.pixelCount());
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < 20; ++x) {
            left[y * kWidth + x] = 1;
            for (uint32_t c = 0; c < 3; ++c) test.pixel(x, y)[c] = 1.5f;
        }
    const Estimate masked = nRmse(test, {reference, reference}, left);
    EXPECT_NEAR(masked.value, 0.5, 1e-6);
    EXPECT_NEAR(masked.interval->high, 0.5, 1e-6);

    // One pixel says nothing of another
    single[70] = 1;
    EXPECT_NEAR(nRmse(test, {reference, reference}, single).value, 0.5, 1e-6);
    EXPECT_FALSE(nRmse(test, {reference, reference}, single).interval);
    EXPECT_THROW(nRmse(test, {reference, reference}, std::vector<uint8_t>(3, 1)), Error);
    const ImageF small(3, 2, 3);
    EXPECT_THROW(nRmse(test, {reference, small}), Error);
}

TEST(Unbiased, IntervalNarrowsWithTheRootOfTheTiles) {
    // Tiles of 16 x 16, of independent pixels: 1.96 standard deviations of the mean to each side.
    std::mt19937 random(2);
    std::normal_distribution<double> normal(1, 0.5);
    for (const uint32_t edge : {128u, 512u}) {
        std::vector<double> values(size_t(edge) * edge);
        for (double& value : values) value = normal(random);
        const Estimate mean = meanOverTiles(values, edge, edge, {});
        const double expected = 2 * 1.96 * 0.5 / edge;
        EXPECT_NEAR((mean.interval->high - mean.interval->low) / expected, 1, 0.2) << edge;
        EXPECT_LT(mean.interval->low, mean.value);
        EXPECT_GT(mean.interval->high, mean.value);
        const Estimate again = meanOverTiles(values, edge, edge, {});
        EXPECT_EQ(again.interval->low, mean.interval->low);
        EXPECT_EQ(again.interval->high, mean.interval->high);
    }
}

TEST(Unbiased, NoiseFloorsAreThoseOfAPerfectImage) {
    std::mt19937 random(9);
    const ImageF right = truth();
    const ImageF a = noisy(right, 0.2, random), b = noisy(right, 0.2, random), mean = meanOf(a, b);
    const ScoreOptions options{-1, flipExposures(mean)};
    const Scores floors = noiseFloors({a, mean, options}, {b, mean, options});
    const Scores perfect = score({right, mean, options});
    EXPECT_EQ(floors.size(), size_t(std::ranges::count_if(metrics(), &Metric::hasNoiseFloor)));
    // About: a half is noisier than the image that it stands for, which windows notice.
    for (const auto& [name, value] : floors) EXPECT_NEAR(value / perfect.at(name), 1, 0.2) << name;
}

}  // namespace
}  // namespace voxray
