#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace voxray {

/// A weighted subset of a list: ascending indices and the weight of each.
struct Resampled {
    std::vector<uint32_t> indices;
    std::vector<float> weights;
};

/// Systematic resampling: selects at most `count` indices, each on average in proportion to its probability.
/// An index that is drawn k times stands once, with the weight k / expected draws; weighted sums over the
/// subset are unbiased. Deterministic.
/// @param probabilities not negative, of a positive sum. @param offset random, in [0, 1).
Resampled systematicResampling(std::span<const double> probabilities, uint32_t count, double offset);

}  // namespace voxray
