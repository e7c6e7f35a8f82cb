#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "image/score.h"
#include "tests/support/errors.h"

/// Metrics against closed forms and what must hold of any image.
namespace voxray {
namespace {

ImageF flat(uint32_t width, uint32_t height, float r, float g, float b) {
    ImageF image(width, height, 3);
    for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = i % 3 == 0 ? r : i % 3 == 1 ? g : b;
    return image;
}
ImageF grey(float value) {
    return flat(32, 24, value, value, value);
}

ImageF waves(float phase) {
    ImageF image(70, 40, 3);
    for (size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = 1.0f + std::sin(float(i % 210) * 0.13f + phase) * std::cos(float(i / 210) * 0.4f);
    return image;
}

std::string scoreError(const ImageF& test, const ImageF& reference) {
    return errorOf([&] { score({test, reference, {}}); });
}

TEST(Metrics, EqualImagesArePerfect) {
    const ImageF image = waves(0);
    const Comparison comparison(image, image, {});
    const Scores scores = score(comparison);
    const ImageF& map = comparison.flip.map;
    EXPECT_EQ(scores.at("flip"), 0);
    EXPECT_EQ(scores.at("flip_ldr"), 0);
    EXPECT_NEAR(scores.at("ssim"), 1, 1e-12);
    EXPECT_EQ(scores.at("psnr_db"), psnrCap);
    EXPECT_EQ(scores.at("nrmse"), 0);
    EXPECT_EQ(scores.at("relmse"), 0);
    EXPECT_EQ(scores.at("mean_ratio"), 1);
    EXPECT_EQ(map.channels, 1u);
    EXPECT_EQ(map.pixelCount(), waves(0).pixelCount());
}

TEST(Metrics, ConstantImagesHaveClosedForms) {
    // 3 where 2 should be: relative error a half, whatever the light's strength.
    for (const float strength : {1.0f, 1e-6f, 1e6f}) {
        const ImageF test = grey(3 * strength), reference = grey(2 * strength);
        EXPECT_NEAR(nRmse(test, reference), 0.5, 1e-6);
        EXPECT_NEAR(relMse(test, reference), 0.25 / 1.01, 1e-6);
        EXPECT_NEAR(meanRatio(test, reference), 1.5, 1e-6);
    }
    EXPECT_NEAR(psnr(grey(0.6f), grey(0.5f)), 20, 1e-5);

    // Without variance only the luminance term of SSIM is left.
    EXPECT_NEAR(ssim(grey(0.6f), grey(0.2f)), (2 * 0.12 + 1e-4) / (0.36 + 0.04 + 1e-4), 1e-6);
}

TEST(Metrics, FlipOfConstantImagesIsTheColourDifference) {
    // Textbook CIELab of sRGB's green and blue, chroma scaled by L / 100: the largest distance.
    const double greenA = -86.185 * 0.87737, greenB = 83.181 * 0.87737;
    const double blueA = 79.197 * 0.32303, blueB = -107.864 * 0.32303;
    const double largest = std::pow(87.737 - 32.303 + std::hypot(greenA - blueA, greenB - blueB), 0.7);

    // White on black is 100 of lightness, beyond the knee; grey of L = 50 against black is not far from it.
    const auto spread = [&](double lightness) {
        const double distance = std::pow(lightness, 0.7), knee = 0.4 * largest;
        return distance < knee ? 0.95 * distance / knee : 0.95 + 0.05 * (distance - knee) / (largest - knee);
    };
    EXPECT_NEAR(flipLdr(grey(1), grey(0)).mean, spread(100), 1e-4);
    EXPECT_NEAR(flipLdr(grey(0.46633f), grey(0)).mean, spread(50), 1e-3);
    EXPECT_NEAR(flipLdr(flat(32, 24, 0, 1, 0), flat(32, 24, 0, 0, 1)).mean, 1, 1e-6);
}

TEST(Metrics, FlipIsSymmetricAndGrowsWithTheError) {
    const ImageF a = preview(waves(0), -1), b = preview(waves(0.3f), -1), c = preview(waves(1.5f), -1);
    const ErrorMap forward = flipLdr(a, b), backward = flipLdr(b, a);
    EXPECT_EQ(forward.map.data, backward.map.data);
    EXPECT_GT(forward.mean, 0);
    EXPECT_GT(flipLdr(a, c).mean, forward.mean);
    for (const float error : flipLdr(a, c).map.data) {
        EXPECT_GE(error, 0.0f);
        EXPECT_LE(error, 1.0f);
    }
}

TEST(Metrics, HdrFlipIsTheWorstOfItsExposures) {
    const ImageF test = waves(0.3f), reference = waves(0);
    const ErrorMap all = flipHdr(test, reference, {-2, 2, 3});
    ImageF worst(reference.width, reference.height, 1);
    for (const double stops : {-2.0, 0.0, 2.0}) {
        const ErrorMap one = flipHdr(test, reference, {stops, stops, 1});
        for (size_t i = 0; i < worst.data.size(); ++i) worst.data[i] = std::max(worst.data[i], one.map.data[i]);
    }
    EXPECT_EQ(all.map.data, worst.data);
    EXPECT_THROW(flipHdr(test, reference, {1, 0, 2}), Error);
    EXPECT_THROW(flipHdr(test, reference, {0, 1, 0}), Error);
    EXPECT_THROW(flipHdr(test, reference, {0, std::numeric_limits<double>::infinity(), 2}), Error);
}

TEST(Metrics, FlipExposuresSpanMedianToLargest) {
    // 16 times the median in one pixel: 4 stops.
    ImageF reference = grey(0.5f);
    for (int c = 0; c < 3; ++c) reference.data[size_t(c)] = 8.0f;
    const FlipExposures exposures = flipExposures(reference);
    EXPECT_NEAR(exposures.stop - exposures.start, 4, 1e-5);
    EXPECT_GE(exposures.count, 4);
    EXPECT_LE(exposures.count, 5);

    // The median ends at 0.85 of the display.
    const double x = 0.6 * 0.5 * std::exp2(exposures.stop);
    EXPECT_NEAR(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.85, 1e-6);

    // A mostly black image has the median of its lit part; a black one a default.
    ImageF dark = grey(0);
    for (size_t i = 0; i < 30; ++i) dark.data[i] = 0.5f;
    EXPECT_NEAR(flipExposures(dark).stop, exposures.stop, 1e-6);
    EXPECT_EQ(flipExposures(grey(0)).start, 0);
    EXPECT_EQ(flipExposures(grey(0)).stop, 0);
    EXPECT_EQ(flipExposures(grey(0)).count, 2);
}

TEST(Metrics, BlackReferencesGiveFiniteScores) {
    const Scores both = score({grey(0), grey(0), {}});
    EXPECT_EQ(both.at("mean_ratio"), 1);
    EXPECT_EQ(both.at("nrmse"), 0);
    const Scores lit = score({grey(0.5f), grey(0), {}});
    EXPECT_EQ(lit.at("mean_ratio"), meanRatioCap);
    EXPECT_NEAR(lit.at("nrmse"), 0.5, 1e-6);
    EXPECT_NEAR(lit.at("relmse"), 25, 1e-4);
}

TEST(Metrics, BlackAndConstantImagesAreTheFloor) {
    const ImageF reference = waves(0);
    const Scores black = score({blackLike(reference), reference, {}});
    EXPECT_EQ(black.at("mean_ratio"), 0);
    const Scores constant = score({constantLike(reference), reference, {}});
    EXPECT_NEAR(constant.at("mean_ratio"), 1, 1e-6);

    // Of a constant image nRMSE is the reference's deviation, so that black adds its mean: 1.
    EXPECT_NEAR(black.at("nrmse") * black.at("nrmse"), 1 + constant.at("nrmse") * constant.at("nrmse"), 1e-3);
}

TEST(Metrics, MaskedScoresAreThoseOfThePixelsUnderTheMask) {
    // Left of column 12: 3 where 2 should be. The rest: 9 where 1 should be.
    ImageF test = grey(9), reference = grey(1);
    std::vector<uint8_t> left(test.pixelCount());
    for (uint32_t y = 0; y < test.height; ++y)
        for (uint32_t x = 0; x < 12; ++x) {
            left[y * test.width + x] = 1;
            for (uint32_t c = 0; c < 3; ++c) {
                test.pixel(x, y)[c] = 3;
                reference.pixel(x, y)[c] = 2;
            }
        }
    EXPECT_NEAR(nRmse(test, reference, left), 0.5, 1e-6);
    EXPECT_NEAR(relMse(test, reference, left), 0.25 / 1.01, 1e-6);
    EXPECT_NEAR(meanRatio(test, reference, left), 1.5, 1e-6);
    EXPECT_NEAR(psnr(preview(test, -3), preview(reference, -3), left), psnr(preview(grey(3), -3), preview(grey(2), -3)),
                1e-9);

    // What lies beyond the mask is seen by windows alone: five pixels off, SSIM and FLIP are those of the
    // flat pair.
    std::vector<uint8_t> inner(test.pixelCount());
    inner[10 * test.width + 2] = 1;
    EXPECT_NEAR(ssim(preview(test, -3), preview(reference, -3), inner),
                ssim(preview(grey(3), -3), preview(grey(2), -3)), 1e-9);

    // A whole mask changes nothing but SSIM, which then counts the border.
    const ImageF shifted = waves(0.3f), still = waves(0);
    const Comparison waved(shifted, still, {});
    const std::vector<uint8_t> all(waved.test.pixelCount(), 1);
    Scores masked = score(waved, all), whole = score(waved);
    masked.erase("ssim");
    whole.erase("ssim");
    for (const auto& [name, value] : whole) EXPECT_NEAR(masked.at(name), value, 1e-6) << name;
    EXPECT_THROW(nRmse(test, reference, std::vector<uint8_t>(3, 1)), Error);
    EXPECT_THROW(nRmse(test, reference, std::vector<uint8_t>(test.pixelCount())), Error);
}

TEST(Metrics, NamesOfTheTableAreUnique) {
    EXPECT_EQ(score({grey(1), grey(1), {}}).size(), metrics().size());
}

TEST(Metrics, WhatCannotBeComparedIsNamed) {
    ImageF broken = grey(1);
    broken.pixel(5, 7)[1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(scoreError(broken, grey(1)), "test image has NaN at (5, 7)");
    broken.pixel(5, 7)[1] = std::numeric_limits<float>::infinity();
    EXPECT_EQ(scoreError(grey(1), broken), "reference image has an infinite value at (5, 7)");
    EXPECT_CONTAINS(scoreError(ImageF(3, 2, 3), ImageF(2, 3, 3)), "3 x 2");
    EXPECT_NE(scoreError(ImageF(3, 2, 1), ImageF(3, 2, 1)), "");
    EXPECT_NE(scoreError(ImageF(), ImageF()), "");
}

TEST(Metrics, ThreadsDoNotChangeABit) {
    ScoreOptions options;
    options.flipExposures = flipExposures(waves(0));
    const auto all = score({waves(0.7f), waves(0), options});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto alone = score({waves(0.7f), waves(0), options});
    EXPECT_EQ(all, alone);
}

}  // namespace
}  // namespace voxray
