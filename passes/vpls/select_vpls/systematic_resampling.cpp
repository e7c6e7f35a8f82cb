#include "passes/vpls/select_vpls/systematic_resampling.h"

#include <cmath>
#include <numeric>

namespace voxray {

Resampled systematicResampling(std::span<const double> probabilities, uint32_t count, double offset) {
    const double sum = std::accumulate(probabilities.begin(), probabilities.end(), 0.0);
    Resampled selected;

    // Indices are segments of [0, count); those that hold points offset + i are selected
    double cumulative = 0, pointsBefore = 0;
    for (uint32_t i = 0; i < probabilities.size(); ++i) {
        const double expected = count * (probabilities[i] / sum);
        cumulative += expected;
        const double pointsUpToHere = std::ceil(cumulative - offset);
        const double points = pointsUpToHere - pointsBefore;
        if (points > 0 && expected > 0) {
            selected.indices.push_back(i);
            selected.weights.push_back(float(points / expected));
        }
        pointsBefore = pointsUpToHere;
    }
    return selected;
}

}  // namespace voxray
