#pragma once

#include <algorithm>

#include "tests/gpu/chain.h"

namespace voxray::test {

/// A mean over frames, which draw independent numbers, and the variance of that mean.
struct Estimate {
    double mean = 0, variance = 0;
};

/// Of the image `indirect`.
inline Estimate meanOfFrames(Chain& chain, int frames) {
    double sum = 0, squares = 0;
    for (int frame = 1; frame <= frames; ++frame) {
        chain.runFrame(uint32_t(frame));
        const double value = mean(chain.image("indirect"));
        sum += value;
        squares += value * value;
    }
    const double n = frames;
    return {sum / n, std::max(squares / n - sum * sum / n / n, 0.0) / (n - 1)};
}

}  // namespace voxray::test
