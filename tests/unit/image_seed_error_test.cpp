#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "image/seed_error.h"

/// Bias and noise against images whose bias and noise are known. The reference's mean is 2.
namespace voxray {
namespace {

constexpr uint32_t kWidth = 128, kHeight = 96;
constexpr float kMean = 2;

/// Independent normal values about `mean`.
ImageF noisy(float mean, float deviation, uint32_t seed) {
    ImageF image(kWidth, kHeight, 3);
    std::mt19937 random(seed);
    std::normal_distribution<float> normal(mean, deviation);
    for (float& value : image.data) value = deviation > 0 ? normal(random) : mean;
    return image;
}

/// Scores of a method of this bias and noise against a reference whose halves have noise, too.
Scores scoresOf(float bias, float noise, float referenceNoise) {
    return seedScores(noisy(kMean + bias, noise, 1), noisy(kMean + bias, noise, 2),
                      {noisy(kMean, referenceNoise, 3), noisy(kMean, referenceNoise, 4)});
}

TEST(SeedError, BiasAloneIsExact) {
    const Scores scores = scoresOf(0.5f, 0, 0);
    EXPECT_NEAR(scores.at("bias_nrmse"), 0.25, 1e-6);
    EXPECT_EQ(scores.at("noise_nrmse"), 0);
}

TEST(SeedError, NoiseOfMethodAndReferenceIsNoBias) {
    const Scores scores = scoresOf(0, 0.4f, 0.3f);
    EXPECT_NEAR(scores.at("noise_nrmse"), 0.2, 0.002);
    EXPECT_EQ(scores.at("bias_nrmse_low"), 0);
    EXPECT_LT(scores.at("bias_nrmse"), 0.02);
}

TEST(SeedError, BothAddUpToTheError) {
    const Scores scores = scoresOf(0.2f, 0.4f, 0.1f);
    EXPECT_NEAR(scores.at("bias_nrmse"), 0.1, 0.005);
    EXPECT_NEAR(scores.at("noise_nrmse"), 0.2, 0.002);
    const ImageF a = noisy(kMean, 0.1f, 3), b = noisy(kMean, 0.1f, 4);
    const double error = nRmse(noisy(kMean + 0.2f, 0.4f, 1), ReferenceHalves{a, b}).value;
    EXPECT_NEAR(std::hypot(scores.at("bias_nrmse"), scores.at("noise_nrmse")), error, 0.003);
}

TEST(SeedError, AMaskSelectsItsPixels) {
    ImageF first = noisy(kMean, 0, 0), second = first;
    const ImageF reference = first;
    first.pixel(5, 7)[1] += 0.6f;  // Differs in one value of one pixel.
    std::vector<uint8_t> mask(first.pixelCount());
    mask[7 * kWidth + 5] = 1;
    const Scores scores = seedScores(first, second, {reference, reference}, mask);
    EXPECT_NEAR(scores.at("noise_nrmse"), 0.6 / std::sqrt(6) / kMean, 1e-6);
    EXPECT_EQ(scores.at("bias_nrmse"), 0);
}

TEST(SeedError, ImagesOfAnotherSizeAreRefused) {
    const ImageF image = noisy(kMean, 0, 0), small(8, 8, 3, 1);
    EXPECT_THROW(seedScores(image, small, {image, image}), Error);
}

}  // namespace
}  // namespace voxray
