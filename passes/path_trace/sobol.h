#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

/// Owen-scrambled Sobol points, two dimensions at a time, padded to any number of dimensions: each pair has
/// its own shuffle of the sample order and its own scramble. Burley 2020, "Practical Hash-based Owen
/// Scrambling"; the hash is Vegdahl's revision of Laine and Karras 2011.
namespace voxray::path_trace {

/// Four numbers that are handled at once.
using Four = uint32_t __attribute__((vector_size(16)));

template <typename Bits>
Bits reverseBits(Bits x) {
    x = ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    return (x << 24) | ((x & 0xff00u) << 8) | ((x >> 8) & 0xff00u) | (x >> 24);
}

/// Owen scrambling of a number whose bits are in reversed order: each bit is flipped depending on the bits
/// below it.
template <typename Bits>
Bits scrambleReversed(Bits x, Bits seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// The second Sobol dimension of a sample index, bits reversed: Pascal's triangle modulo 2.
template <typename Bits>
Bits secondDimensionReversed(Bits index) {
    index ^= (index & 0xaaaaaaaau) >> 1;
    index ^= (index & 0xccccccccu) >> 2;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xff00ff00u) >> 8;
    index ^= index >> 16;
    return index;
}

/// A well mixed 32-bit hash (murmur3's finaliser).
inline uint32_t mixBits(uint32_t x) {
    x ^= x >> 16;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    x *= 0xc2b2ae35u;
    x ^= x >> 16;
    return x;
}

inline uint32_t hashOf(uint32_t a, uint32_t b) {
    return mixBits(a ^ (mixBits(b + 0x9e3779b9u) * 0x9e3779b1u));
}

/// A number in [0, 1) from the upper 24 bits: exact in float and never 1.
inline float unitFloat(uint32_t bits) {
    return float(int32_t(bits >> 8)) * 0x1p-24f;
}

/// One sequence of points in [0, 1)^d, one point a sample index. Dimensions are made when they are asked for.
class SobolSampler {
 public:
    SobolSampler() = default;
    /// `seed` selects the sequence; `index` the point on it.
    SobolSampler(uint32_t seed, uint32_t index) : seed_(seed), reversedIndex_(reverseBits(index)) {}

    /// Two dimensions that are a (0,2)-sequence in the index; any two numbers give independent pairs.
    glm::vec2 pair(uint32_t number) const {
        const uint32_t seed = hashOf(seed_, number);
        const uint32_t index = reverseBits(scrambleReversed(reversedIndex_, seed));
        const uint32_t x = scrambleReversed(index, seed * 0x2c1b3c6du + 0x297a2d39u);
        const uint32_t y = scrambleReversed(secondDimensionReversed(index), seed * 0x7feb352du + 0x846ca68bu);
        return {unitFloat(reverseBits(x)), unitFloat(reverseBits(y))};
    }

    /// Two pairs at once, the same numbers as pair() gives.
    std::array<glm::vec2, 2> pairs(uint32_t first, uint32_t second) const {
        const uint32_t a = hashOf(seed_, first), b = hashOf(seed_, second);
        const Four reversed = {reversedIndex_, reversedIndex_, reversedIndex_, reversedIndex_};
        const Four seeds = {a, b, a, b};
        const Four index = reverseBits(scrambleReversed(reversed, seeds));
        const Four other = secondDimensionReversed(index);
        const Four both = {index[0], index[1], other[2], other[3]};
        const Four scrambles = seeds * Four{0x2c1b3c6du, 0x2c1b3c6du, 0x7feb352du, 0x7feb352du} +
                               Four{0x297a2d39u, 0x297a2d39u, 0x846ca68bu, 0x846ca68bu};
        const Four bits = reverseBits(scrambleReversed(both, scrambles));
        return {glm::vec2(unitFloat(bits[0]), unitFloat(bits[2])),
                glm::vec2(unitFloat(bits[1]), unitFloat(bits[3]))};
    }

    /// The first dimension of a pair alone.
    float one(uint32_t number) const {
        const uint32_t seed = hashOf(seed_, number);
        const uint32_t index = reverseBits(scrambleReversed(reversedIndex_, seed));
        return unitFloat(reverseBits(scrambleReversed(index, seed * 0x2c1b3c6du + 0x297a2d39u)));
    }

 private:
    uint32_t seed_ = 0;
    uint32_t reversedIndex_ = 0;
};

}  // namespace voxray::path_trace
