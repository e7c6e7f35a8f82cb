#pragma once

#include <array>
#include <tuple>
#include <utility>

#include "base/schema.h"

namespace voxray {

/// Light that is denoised.
enum class FilteredLight { Indirect, Direct, Residual };
template <>
struct EnumNames<FilteredLight> {
    static constexpr std::array names{std::pair{FilteredLight::Indirect, "indirect"},
                                      std::pair{FilteredLight::Direct, "direct"},
                                      std::pair{FilteredLight::Residual, "residual"}};
};

/// What an element's value is, of the weighted taps around it.
enum class Estimator { Mean, Regression };
template <>
struct EnumNames<Estimator> {
    static constexpr std::array names{std::pair{Estimator::Mean, "mean"},
                                      std::pair{Estimator::Regression, "regression"}};
};

/// Parameters of the pass `filter_irradiance`.
struct FilterIrradianceParams {
    FilteredLight light = FilteredLight::Indirect;
    Estimator estimator = Estimator::Mean;
    uint32_t levels = 0;
    float edgeStoppingScale = 0.0f;
    static constexpr auto schema() {
        return std::tuple{
            field("light", &FilterIrradianceParams::light,
                  "indirect: reads 'noisy_irradiance' and writes 'indirect'. "
                  "direct: reads 'noisy_direct', adds 'unfiltered_direct' and writes 'direct'. "
                  "residual: reads 'noisy_residual', which may be negative, adds 'indirect' and "
                  "writes 'indirect'."),
            field("estimator", &FilterIrradianceParams::estimator,
                  "mean: the weighted mean of taps. regression: wider, with less error and 2.3 times "
                  "the time: linear regression on position, noise measured, outliers bounded and what "
                  "they lose given back around them, means of wider neighborhoods, one more level.")
                .onlyWith(oneOf(&FilterIrradianceParams::light, {FilteredLight::Indirect, FilteredLight::Direct})),
            field("levels", &FilterIrradianceParams::levels,
                  "Levels of the wavelet, each with twice the radius of the previous one: "
                  "n levels have a radius of 2^n - 1 pixels. 0: 4, with regression 5, of residuals 6.",
                  0u, 6u),
            field("edge_stopping_scale", &FilterIrradianceParams::edgeStoppingScale,
                  "Factor of the bound of the difference of irradiance between two texels. "
                  "1: the whole bound, sharp and noisy; less: smoother, and shadows blur. "
                  "0: 0.1 for indirect light, most of whose changes cancel, with regression 0.02; "
                  "1 for direct light, where the edge of a shadow is a single change.",
                  0.0f, 100.0f)};
    }
};

}  // namespace voxray
