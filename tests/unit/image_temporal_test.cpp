#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "image/temporal.h"

/// Temporal error against closed forms. The reference's mean is 2, so that scores are half of radiances.
namespace voxray {
namespace {

constexpr uint32_t kWidth = 24, kHeight = 16;

ImageF grey(float value) {
    return ImageF(kWidth, kHeight, 3, value);
}

/// Values of 1 and 3 that swap places from frame to frame: their mean stays.
ImageF checkered(int frame, double error) {
    ImageF image = grey(0);
    for (size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = ((i + size_t(frame)) % 2 ? 1.0f : 3.0f) + float(error);
    return image;
}

/// Scores of frames whose error in frame t is errorOf(t).
template <typename ErrorOf>
Scores scoresOf(int frames, const ErrorOf& errorOf) {
    TemporalError temporal;
    for (int t = 0; t < frames; ++t) {
        const ImageF reference = checkered(t, 0);
        temporal.add(checkered(t, errorOf(t)), {reference, reference});
    }
    return temporal.scores();
}

TEST(TemporalError, ErrorThatStaysHasNone) {
    const Scores scores = scoresOf(6, [](int) { return 0.5; });
    for (const MetricInfo& metric : temporalMetrics()) EXPECT_EQ(scores.at(metric.name), 0) << metric.name;
}

TEST(TemporalError, AlternatingErrorIsFlicker) {
    // Errors of ±0.25: steps of ±0.5, of which 0.25 in units of the mean. Of an even number of steps the mean
    // is 0.
    const Scores even = scoresOf(7, [](int t) { return t % 2 ? -0.25 : 0.25; });
    EXPECT_NEAR(even.at("temporal_flicker"), 0.25, 1e-6);
    EXPECT_NEAR(even.at("temporal_bias"), 0, 1e-6);
    EXPECT_NEAR(even.at("temporal_nrmse"), 0.25, 1e-6);

    // Of T = 5 steps one is left over: the mean is a fifth of it.
    const Scores odd = scoresOf(6, [](int t) { return t % 2 ? -0.25 : 0.25; });
    EXPECT_NEAR(odd.at("temporal_bias"), 0.25 / 5, 1e-6);
    EXPECT_NEAR(odd.at("temporal_flicker"), 0.25 * std::sqrt(1 - 1.0 / 25), 1e-6);
}

TEST(TemporalError, ErrorThatGrowsEvenlyIsBias) {
    const Scores scores = scoresOf(6, [](int t) { return 0.125 * t; });
    EXPECT_NEAR(scores.at("temporal_bias"), 0.125 / 2, 1e-6);
    EXPECT_NEAR(scores.at("temporal_flicker"), 0, 1e-6);
    EXPECT_NEAR(scores.at("temporal_nrmse"), 0.125 / 2, 1e-6);
}

TEST(TemporalError, SquaresOfBiasAndFlickerAddUp) {
    const Scores scores = scoresOf(6, [](int t) { return 0.1 * t * t + (t % 3 == 1 ? 0.3 : 0); });
    const double bias = scores.at("temporal_bias"), flicker = scores.at("temporal_flicker");
    EXPECT_GT(bias, 0.01);
    EXPECT_GT(flicker, 0.01);
    EXPECT_NEAR(std::hypot(bias, flicker), scores.at("temporal_nrmse"), 1e-9);
}

TEST(TemporalError, FramesHaveTheirOwnErrors) {
    TemporalError temporal;
    EXPECT_TRUE(temporal.scores().empty());
    const ImageF two = grey(2), small(3, 2, 3);
    for (const float error : {0.0f, 0.5f, 0.5f, -0.5f}) temporal.add(grey(2 + error), {two, two});
    const std::vector<double> errors = temporal.frameErrors();
    ASSERT_EQ(errors.size(), 3u);
    EXPECT_NEAR(errors[0], 0.25, 1e-6);
    EXPECT_NEAR(errors[1], 0, 1e-6);
    EXPECT_NEAR(errors[2], 0.5, 1e-6);
    EXPECT_THROW(temporal.add(small, {small, small}), Error);
}

TEST(TemporalError, NoiseOfTheReferenceAddsNothing) {
    // References of standard deviation 0.1 a half, independent from frame to frame, and errors of ±0.05:
    // steps of 0.1, where the noise of the mean makes steps of 0.1 too. In units of the mean half of that.
    std::mt19937 random(7);
    std::normal_distribution<float> noise(0, 0.1f);
    for (const float error : {0.05f, 0.0f}) {
        TemporalError temporal;
        for (int t = 0; t < 9; ++t) {
            ImageF a = grey(2), b = grey(2);
            for (ImageF* half : {&a, &b})
                for (float& value : half->data) value += noise(random);
            temporal.add(grey(2 + (t % 2 ? -error : error)), {a, b});
        }
        const Scores scores = temporal.scores();
        EXPECT_LE(scores.at("temporal_flicker_low"), error);
        EXPECT_GE(scores.at("temporal_flicker_high"), error);
        EXPECT_LE(scores.at("temporal_bias_low"), 0);
        EXPECT_LT(scores.at("temporal_nrmse_high"), error + 0.02);
    }
}

}  // namespace
}  // namespace voxray
