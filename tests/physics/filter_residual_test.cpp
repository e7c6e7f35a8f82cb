// The irradiance filter over residuals, which have either sign and add to stored light.
#include <gtest/gtest.h>

#include <cmath>

#include "known_irradiance.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

/// A residual that is filtered and added to 2 W/m² of stored light, which has no noise.
ImageF filterResidual(const std::string& residual, const std::string& filter = "levels: 6") {
    Chain chain("white_room", "{albedo: 0.5}",
                "[{pass: gbuffer}, {pass: known_irradiance}, {pass: filter_irradiance}, "
                "{pass: known_irradiance, id: residual, " +
                    residual +
                    "}, {pass: filter_irradiance, id: sum, light: residual, "
                    "inputs: {noisy_residual: residual.noisy_irradiance}, " +
                    filter + "}]",
                48, 48, 1, [](Registry& registry) { registry.add<KnownIrradiance>(); });
    return chain.image("indirect");
}

TEST(FilterIrradiance, ResidualsMayBeNegative) {
    for (const float value : filterResidual("offset: -3, moments: true").data)
        EXPECT_NEAR(value, 0.5 * (2 - 1) / kPi, 1e-3 * 0.5 / kPi);
}

TEST(FilterIrradiance, ResidualsOfNoMeanVanish) {
    // Noise of ±2 around 0, of which nothing may be left but little, dark or bright: sigma is 2 / sqrt(3)
    const ImageF image = filterResidual("noise: 1, offset: -2, moments: true");
    const double stored = 0.5 * 2 / kPi, sigma = stored / std::sqrt(3.0);
    EXPECT_NEAR(mean(image), stored, 4 * 2 * sigma / 48);
    double squares = 0;
    for (const float value : image.data) squares += std::pow(value - stored, 2);
    EXPECT_LT(std::sqrt(squares / double(image.data.size())), 0.08 * sigma);
}

TEST(FilterIrradiance, ResidualsKeepWhatIsBeyondDoubt) {
    // -1 on the left and 1 on the right, with noise that is a twentieth of it
    const ImageF image = filterResidual("noise: 0.2, rays: 16, step: 2, offset: -3, moments: true");
    const auto column = [&](uint32_t x) {
        double sum = 0;
        for (uint32_t y = 0; y < image.height; ++y) sum += image.data[3 * (size_t(y) * image.width + x)];
        return sum / image.height / (0.5 / kPi) - 2;
    };
    EXPECT_NEAR(column(19), -1, 0.2);
    EXPECT_NEAR(column(28), 1, 0.2);
}

TEST(FilterIrradiance, OutliersOfResidualsAreBoundedAndGivenBack) {
    // One texel of the wall has a thousand times what its surroundings lack, of either sign. The bound leaves less than
    // half of it there, and brings the rest back all over the wall.
    const double stored = 0.5 * 2 / kPi;
    for (const std::string factor : {"1", "-1"}) {
        const std::string source = "scale: " + factor + ", noise: 1, firefly: 1000";
        const ImageF raw = filterResidual(source, "levels: 1"),
                     bounded = filterResidual(source + ", moments: true", "levels: 1");
        const auto residual = [&](const ImageF& image) { return mean(image) - stored; };
        const auto center = [&](const ImageF& image) { return image.pixel(24, 24)[1] - stored; };
        EXPECT_NEAR(residual(bounded) / residual(raw), 1, 0.05) << factor;
        EXPECT_LT(center(bounded) / center(raw), 0.5) << factor;
    }
}

TEST(FilterIrradiance, ResidualsNeedStoredLight) {
    EXPECT_CONTAINS(errorOf([] {
                        Chain("white_room", "{}",
                              "[{pass: gbuffer}, {pass: known_irradiance, id: residual}, {pass: filter_irradiance, "
                              "light: residual, inputs: {noisy_residual: residual.noisy_irradiance}}]",
                              16, 16, 1, [](Registry& registry) { registry.add<KnownIrradiance>(); });
                    }),
                    "put a filter_irradiance of stored light there");
}

}  // namespace
}  // namespace voxray::test
