#include "passes/hybrid_leaves/gather_mirror/schlick_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "passes/hybrid_leaves/gather_mirror/mirror_types.h"

namespace voxray {
namespace {

constexpr int kTablePoints = 64;  // Along an edge of the unit square: errors are below 1e-4.

/// For one cosine of the viewer, by the midpoint rule over cosine-distributed directions.
double meanSchlickWeight(double cosOut) {
    const double sinOut = std::sqrt(1 - cosOut * cosOut);
    double sum = 0;
    for (int i = 0; i < kTablePoints; ++i)
        for (int j = 0; j < kTablePoints; ++j) {
            const double u = (i + 0.5) / kTablePoints, phi = 2 * std::numbers::pi * (j + 0.5) / kTablePoints;
            const double cosOutIn = std::sqrt(u) * std::cos(phi) * sinOut + std::sqrt(1 - u) * cosOut;
            const double cosHalf = std::sqrt(std::max(0.5 * (1 + cosOutIn), 0.0));
            sum += std::pow(1 - cosHalf, 5);
        }
    return sum / (kTablePoints * kTablePoints);
}

}  // namespace

std::vector<float> schlickTable() {
    std::vector<float> table;
    for (int i = 0; i < SCHLICK_TABLE_SIZE; ++i) {
        const double root = double(i) / (SCHLICK_TABLE_SIZE - 1);
        table.push_back(float(meanSchlickWeight(root * root)));
    }
    return table;
}

}  // namespace voxray
