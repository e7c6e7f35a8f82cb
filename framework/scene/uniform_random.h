#pragma once

#include <cstdint>
#include <random>

namespace voxray {

/// Random numbers that are equal on all machines, unlike the standard library's distributions.
class UniformRandom {
 public:
    explicit UniformRandom(uint32_t seed) : random_(seed) {}

    /// In [low, high).
    float operator()(float low, float high) {
        return low + (high - low) * float(random_() >> 8) * (1.0f / 16777216.0f);
    }
    /// In 0 ... count - 1. @param count at least 1.
    uint32_t below(uint32_t count) { return uint32_t((uint64_t(random_()) * count) >> 32); }

 private:
    std::mt19937 random_;
};

}  // namespace voxray
