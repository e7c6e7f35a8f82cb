// What packing loses of a voxel's material and light, against the bounds that docs/voxels.md gives.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "shaders/voxels/voxel_packing.h"

namespace voxray::gpu {
namespace {

constexpr int kSamples = 200000;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float wordAsFloat(uint word) {
    return uintBitsToFloat(word);
}

TEST(VoxelPacking, AreasKeepTwelveBits) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> exponent(-20, 10.9f);
    double worst = 0;
    for (int i = 0; i < kSamples; ++i) {
        const float area = std::exp2(exponent(random));
        const uint packed = packArea(area);
        worst = std::max(worst, std::abs(double(unpackArea(packed)) / area - 1));
        ASSERT_EQ(packArea(unpackArea(packed)), packed) << area;
    }
    EXPECT_LE(worst, 1.0001 / (1 << 12));
    EXPECT_EQ(unpackArea(packArea(0)), 0);
    EXPECT_EQ(unpackArea(packArea(1)), 1);
    EXPECT_NEAR(unpackArea(packArea(1e9f)), 1919, 1);
}

TEST(VoxelPacking, LightKeepsThirteenBitsOfTheLargestChannel) {
    // Over all of the range of floats but its lowest end.
    std::mt19937 random(1);
    std::uniform_real_distribution<float> exponent(-113, 127), channel(0, 1);
    double worst = 0, sum = 0;
    for (int i = 0; i < kSamples; ++i) {
        const vec3 rgb = std::exp2(exponent(random)) * vec3(channel(random), channel(random), channel(random));
        const float largest = max(rgb.x, max(rgb.y, rgb.z));
        const uvec2 packed = packRgb(rgb);
        const vec3 unpacked = unpackRgb(packed);
        if (largest < 1e-33f) continue;
        for (int c = 0; c < 3; ++c) {
            const double error = (double(unpacked[c]) - rgb[c]) / largest;
            worst = std::max(worst, std::abs(error));
            sum += error;
        }
        ASSERT_EQ(packRgb(unpacked), packed);
    }
    EXPECT_LE(worst, 1.0001 / (1 << 13));
    // Errors have no preferred sign: light that passes from bounce to bounce does not drift.
    EXPECT_LT(std::abs(sum / (3.0 * kSamples)), 1e-6);
    EXPECT_EQ(packRgb(vec3(0)), uvec2(0));
    EXPECT_EQ(unpackRgb(packRgb(vec3(0, 3, 0.5f))), vec3(0, 3, 0.5f));
}

TEST(VoxelPacking, ScalingByPowersOfTwoIsExact) {
    const vec3 rgb(0.3f, 0.71f, 0.013f);
    for (int k = -60; k <= 60; ++k)
        EXPECT_EQ(unpackRgb(packRgb(std::ldexp(1.0f, k) * rgb)), std::ldexp(1.0f, k) * unpackRgb(packRgb(rgb)));
}

TEST(VoxelPacking, WordsAreFiniteWhereValuesAre) {
    // The finite check reads packed words as floats.
    for (uint upper = 0; upper < 0xff00u; ++upper)
        ASSERT_TRUE(std::isfinite(wordAsFloat(packPair(0xfefe, upper)))) << upper;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> any(0, 1000);
    for (int i = 0; i < kSamples; ++i) {
        const uvec3 flux = packFlux(vec3(any(random), any(random), any(random)), vec3(any(random)));
        for (int k = 0; k < 3; ++k) ASSERT_TRUE(std::isfinite(wordAsFloat(flux[k])));
    }
    for (const float bad : {kInfinity, -kInfinity, std::nanf("")}) {
        EXPECT_FALSE(std::isfinite(wordAsFloat(packFlux(vec3(bad, 1, 1), vec3(0)).x)));
        EXPECT_FALSE(std::isfinite(wordAsFloat(packFlux(vec3(0), vec3(1, 1, bad)).y)));
        EXPECT_FALSE(std::isfinite(wordAsFloat(packPair(packArea(bad), packArea(1)))));
        EXPECT_FALSE(std::isfinite(wordAsFloat(packPair(packArea(1), packArea(bad)))));
        EXPECT_FALSE(std::isfinite(wordAsFloat(packPair(packUnorm(bad), packSnorm(0)))));
    }
    EXPECT_FALSE(std::isfinite(wordAsFloat(packRgb(vec3(std::numeric_limits<float>::max())).x)));
}

TEST(VoxelPacking, AMaterialComesBack) {
    VoxelMaterial m;
    m.albedo = vec3(0.1f, 0.5f, 1);
    m.opacity = 11.0f / 16;
    m.normal = vec3(-1, 0, 0.6f);
    m.area = 2.7f;
    m.emission = vec3(0, 17, 3);
    m.metallic = 1;
    m.unoccludedPositive = vec3(0, 0.25f, 1);
    m.unoccludedNegative = vec3(2, 0.125f, 0);
    m.roughness = 0.2f;
    const VoxelMaterial back = unpackMaterial(packMaterial(m));
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(back.albedo[c], m.albedo[c], 1.0 / (1 << 16));
        EXPECT_NEAR(back.normal[c], m.normal[c], 1.0 / (1 << 15));
    }
    EXPECT_EQ(back.normal.y, 0);
    EXPECT_EQ(back.albedo.z, 1);
    EXPECT_EQ(back.emission, m.emission);
    EXPECT_EQ(back.opacity, m.opacity);
    EXPECT_EQ(back.unoccludedPositive, m.unoccludedPositive);
    EXPECT_EQ(back.unoccludedNegative, m.unoccludedNegative);
    EXPECT_NEAR(back.area, m.area, m.area / (1 << 12));
    EXPECT_EQ(back.metallic, 1);
    EXPECT_NEAR(back.roughness, m.roughness, 0.5 / 255);
    static_assert(sizeof(PackedVoxelMaterial) == 36);
}

}  // namespace
}  // namespace voxray::gpu
