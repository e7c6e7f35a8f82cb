#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace voxray {

/// What is kept of a list: places in it, ascending, and the factor by which each counts for more.
struct Resampled {
    std::vector<uint32_t> places;
    std::vector<float> weights;
};

/// Systematic resampling: of the places of `probabilities` (not negative, of any sum that is positive),
/// `count` at most, each on average `count` times its part of the sum. A place with several counts once,
/// with as much weight; the weighted sum over what is kept is that over all on average. Deterministic.
/// @param offset in [0, 1): random.
Resampled resample(std::span<const double> probabilities, uint32_t count, double offset);

}  // namespace voxray
