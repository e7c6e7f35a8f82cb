#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/srgb.h"
#include "image/image.h"

namespace voxray {
namespace {

using Color = std::array<double, 3>;

void expectNear(const Color& color, const Color& expected, double tolerance) {
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(color[c], expected[c], tolerance) << "channel " << c;
}

// Expected values are the specification's: f = x - x²/0.16 up to 0.08, else 0.04; p_n = 1 - 0.0576 / (p -
// 0.52).
TEST(Tone, PbrNeutralFollowsItsSpecification) {
    expectNear(pbrNeutral({0, 0, 0}), {0, 0, 0}, 0);
    expectNear(pbrNeutral({0.04, 0.04, 0.04}), {0.01, 0.01, 0.01}, 1e-12);
    expectNear(pbrNeutral({0.5, 0.3, 0.02}), {0.4825, 0.2825, 0.0025}, 1e-12);
    expectNear(pbrNeutral({0.8, 0.5, 0.08}), {0.76, 0.46, 0.04}, 1e-12);
    expectNear(pbrNeutral({2, 2, 2}), {0.96, 0.96, 0.96}, 1e-12);
    expectNear(pbrNeutral({1, 0, 0}), {0.88, 0.0155599214145383, 0.0155599214145383}, 1e-12);
    expectNear(pbrNeutral({5.04, 1.04, 0.24}), {0.987142857142857, 0.494165642178751, 0.395570199185930}, 1e-12);
    expectNear(pbrNeutral({-1, 0.5, 0.3}), pbrNeutral({0, 0.5, 0.3}), 0);
}

TEST(Tone, PbrNeutralIsMonotoneAndContinuousAndKeepsGrey) {
    Color before{};
    for (double x = 1e-6; x < 1e8; x *= 1.01) {
        const Color grey = pbrNeutral({x, x, x});
        EXPECT_EQ(grey[0], grey[1]);
        EXPECT_EQ(grey[0], grey[2]);
        EXPECT_GT(grey[0], before[0]) << x;
        EXPECT_LE(grey[0], 1) << x;
        before = grey;
    }
    for (const double joint : {0.08, 0.8}) {
        const double below = joint - 1e-9, above = joint + 1e-9;
        expectNear(pbrNeutral({below, below, below}), pbrNeutral({above, above, above}), 1e-8);
        expectNear(pbrNeutral({below, 0.08, 0.08}), pbrNeutral({above, 0.08, 0.08}), 1e-8);
    }
    for (const double x : {1e30, double(INFINITY)}) expectNear(pbrNeutral({x, x, x}), {1, 1, 1}, 1e-12);
}

TEST(Tone, PbrNeutralStaysInRangeAndScalesMonotonically) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> stops(-8, 8);
    for (int i = 0; i < 2000; ++i) {
        const Color color{std::exp2(stops(random)), std::exp2(stops(random)), std::exp2(stops(random))};
        const Color shown = pbrNeutral(color);
        for (const double c : shown) EXPECT_TRUE(c >= 0 && c <= 1) << c;
        const Color brighter = pbrNeutral({1.1 * color[0], 1.1 * color[1], 1.1 * color[2]});
        EXPECT_GE(*std::ranges::max_element(brighter), *std::ranges::max_element(shown));
    }
}

TEST(Tone, PreviewsApplyTheirCurveBetweenExposureAndTransferFunction) {
    ImageF linear(2, 1, 3);
    linear.data = {0.25f, 0.15f, 0.01f, 1, 1, 1};
    const ImageF clipped = preview(linear, 1), neutral = preview(linear, 1, ToneCurve::PbrNeutral);
    EXPECT_NEAR(clipped.data[0], srgbEncode(0.5), 1e-6);
    EXPECT_NEAR(clipped.data[3], 1, 1e-6);
    EXPECT_NEAR(neutral.data[0], srgbEncode(0.4825), 1e-6);
    EXPECT_NEAR(neutral.data[2], srgbEncode(0.0025), 1e-6);
    EXPECT_NEAR(neutral.data[3], srgbEncode(0.96), 1e-6);

    ImageF grey(1, 1, 1, 2.0f);
    EXPECT_NEAR(preview(grey, 0, ToneCurve::PbrNeutral).data[0], srgbEncode(0.96), 1e-6);
}

}  // namespace
}  // namespace voxray
