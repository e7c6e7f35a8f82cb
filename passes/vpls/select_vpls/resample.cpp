#include "passes/vpls/select_vpls/resample.h"

#include <cmath>
#include <numeric>

namespace voxray {

Resampled resample(std::span<const double> probabilities, uint32_t count, double offset) {
    const double sum = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
    Resampled kept;

    // Places are segments of [0, count); those that hold points offset + i stay.
    double end = 0, pointsBefore = 0;
    for (uint32_t place = 0; place < probabilities.size(); ++place) {
        const double expected = count * (probabilities[place] / sum);
        end += expected;
        const double pointsUpTo = std::ceil(end - offset);
        const double points = pointsUpTo - pointsBefore;
        if (points > 0 && expected > 0) {
            kept.places.push_back(place);
            kept.weights.push_back(float(points / expected));
        }
        pointsBefore = pointsUpTo;
    }
    return kept;
}

}  // namespace voxray
