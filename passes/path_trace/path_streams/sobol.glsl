// Owen-scrambled Sobol points, padded: the numbers of passes/path_trace/sobol.h, bit for bit, with its sources.
#ifndef VOXRAY_PATH_SOBOL_GLSL
#define VOXRAY_PATH_SOBOL_GLSL

struct SobolSampler {
    uint seed;
    uint reversedIndex;
};

uint mixBits(uint x) {
    x ^= x >> 16;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    x *= 0xc2b2ae35u;
    return x ^ (x >> 16);
}

uint hashOf(uint a, uint b) { return mixBits(a ^ (mixBits(b + 0x9e3779b9u) * 0x9e3779b1u)); }

uint scrambleReversed(uint x, uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

// The second Sobol dimension of a sample index, bit-reversed.
uint secondDimensionReversed(uint index) {
    index ^= (index & 0xaaaaaaaau) >> 1;
    index ^= (index & 0xccccccccu) >> 2;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xff00ff00u) >> 8;
    return index ^ (index >> 16);
}

float unitFloat(uint bits) { return float(bits >> 8) * (1.0 / 16777216.0); }

SobolSampler makeSampler(uint seed, uint index) { return SobolSampler(seed, bitfieldReverse(index)); }

// The point of the sampler's index in the sequence of a pair of dimensions, in [0, 1)².
vec2 sobol2D(SobolSampler s, uint pair) {
    const uint seed = hashOf(s.seed, pair);
    const uint index = bitfieldReverse(scrambleReversed(s.reversedIndex, seed));
    const uint x = scrambleReversed(index, seed * 0x2c1b3c6du + 0x297a2d39u);
    const uint y = scrambleReversed(secondDimensionReversed(index), seed * 0x7feb352du + 0x846ca68bu);
    return vec2(unitFloat(bitfieldReverse(x)), unitFloat(bitfieldReverse(y)));
}

// The first coordinate of sobol2D().
float sobol1D(SobolSampler s, uint pair) {
    const uint seed = hashOf(s.seed, pair);
    const uint index = bitfieldReverse(scrambleReversed(s.reversedIndex, seed));
    return unitFloat(bitfieldReverse(scrambleReversed(index, seed * 0x2c1b3c6du + 0x297a2d39u)));
}

#endif
