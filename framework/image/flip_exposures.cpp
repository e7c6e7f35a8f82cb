#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/flip_tone.h"
#include "image/metrics.h"
#include "image/plane.h"

namespace voxray {

FlipExposures flipExposures(const ImageF& reference) {
    if (reference.channels != 3) throw Error("FLIP needs an image of 3 channels, not {}", reference.channels);
    checkFinite(reference, "reference image");

    // Largest and median luminance; the median of nonblack pixels if most are black.
    std::vector<double> luminances(reference.pixelCount());
    for (size_t i = 0; i < luminances.size(); ++i) {
        const float* rgb = &reference.data[i * 3];
        luminances[i] = 0.2126 * double(rgb[0]) + 0.7152 * double(rgb[1]) + 0.0722 * double(rgb[2]);
    }
    std::sort(luminances.begin(), luminances.end());
    if (luminances.empty() || !(luminances.back() > 0)) return {};
    const auto median = [](std::span<const double> sorted) {
        return (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2;
    };
    double center = median(luminances);
    if (!(center > 0)) {
        const auto lit = std::upper_bound(luminances.begin(), luminances.end(), 0.0);
        center = median({lit, luminances.end()});
    }

    // The exposures that map them to 0.85.
    const double target = acesInverse(0.85);
    FlipExposures exposures;
    exposures.start = std::log2(target / luminances.back());
    exposures.stop = std::log2(target / center);
    exposures.count = int(std::max(2.0, std::ceil(exposures.stop - exposures.start)));
    return exposures;
}

}  // namespace voxray
