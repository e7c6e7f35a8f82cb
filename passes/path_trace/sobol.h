#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

/// Owen-scrambled Sobol points, padded: each pair of dimensions is a 2D sequence with its own shuffle of the
/// sample order and its own scramble. Burley 2020, "Practical Hash-based Owen Scrambling"; the hash is
/// Vegdahl's revision of Laine and Karras 2011.
namespace voxray::path_trace {

/// SIMD vector of four numbers.
using Uint4 = uint32_t __attribute__((vector_size(16)));

template <typename Bits>
Bits reverseBits(Bits x) {
    x = ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
    x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
    return (x << 24) | ((x & 0xff00u) << 8) | ((x >> 8) & 0xff00u) | (x >> 24);
}

/// Owen scrambling of a bit-reversed number: each bit is flipped depending on the bits below it.
template <typename Bits>
Bits scrambleReversed(Bits x, Bits seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// The second Sobol dimension of a sample index, bit-reversed: Pascal's triangle modulo 2.
template <typename Bits>
Bits secondDimensionReversed(Bits index) {
    index ^= (index & 0xaaaaaaaau) >> 1;
    index ^= (index & 0xccccccccu) >> 2;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xff00ff00u) >> 8;
    index ^= index >> 16;
    return index;
}

/// 32-bit hash (murmur3's finalizer).
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

/// A float in [0, 1) of the upper 24 bits: exact, and never 1.
inline float unitFloat(uint32_t bits) {
    return float(int32_t(bits >> 8)) * 0x1p-24f;
}

/// A point of a sequence in [0, 1)^d. Dimensions are computed on demand.
class SobolSampler {
 public:
    SobolSampler() = default;
    /// @param seed selects the sequence. @param index of the point in it.
    SobolSampler(uint32_t seed, uint32_t index) : seed_(seed), reversedIndex_(reverseBits(index)) {}

    /// A 2D sample: a (0,2)-sequence in the index. Different pairs of dimensions are independent.
    glm::vec2 get2D(uint32_t pair) const {
        const uint32_t seed = hashOf(seed_, pair);
        const uint32_t index = reverseBits(scrambleReversed(reversedIndex_, seed));
        const uint32_t x = scrambleReversed(index, seed * 0x2c1b3c6du + 0x297a2d39u);
        const uint32_t y = scrambleReversed(secondDimensionReversed(index), seed * 0x7feb352du + 0x846ca68bu);
        return {unitFloat(reverseBits(x)), unitFloat(reverseBits(y))};
    }

    /// Two 2D samples at once, as get2D() gives them.
    std::array<glm::vec2, 2> get2Dx2(uint32_t first, uint32_t second) const {
        const uint32_t a = hashOf(seed_, first), b = hashOf(seed_, second);
        const Uint4 reversed = {reversedIndex_, reversedIndex_, reversedIndex_, reversedIndex_};
        const Uint4 seeds = {a, b, a, b};
        const Uint4 index = reverseBits(scrambleReversed(reversed, seeds));
        const Uint4 secondDimension = secondDimensionReversed(index);
        const Uint4 dimensions = {index[0], index[1], secondDimension[2], secondDimension[3]};
        const Uint4 scrambles = seeds * Uint4{0x2c1b3c6du, 0x2c1b3c6du, 0x7feb352du, 0x7feb352du} +
                                Uint4{0x297a2d39u, 0x297a2d39u, 0x846ca68bu, 0x846ca68bu};
        const Uint4 bits = reverseBits(scrambleReversed(dimensions, scrambles));
        return {glm::vec2(unitFloat(bits[0]), unitFloat(bits[2])), glm::vec2(unitFloat(bits[1]), unitFloat(bits[3]))};
    }

    /// The first coordinate of get2D().
    float get1D(uint32_t pair) const {
        const uint32_t seed = hashOf(seed_, pair);
        const uint32_t index = reverseBits(scrambleReversed(reversedIndex_, seed));
        return unitFloat(reverseBits(scrambleReversed(index, seed * 0x2c1b3c6du + 0x297a2d39u)));
    }

 private:
    uint32_t seed_ = 0;
    uint32_t reversedIndex_ = 0;
};

}  // namespace voxray::path_trace
