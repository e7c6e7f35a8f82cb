#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec2.hpp>

#include "passes/path_trace/path_tracer.h"
#include "passes/path_trace/sobol.h"

/// Which points of which sequence a pixel's samples take. Device: path_streams/path_batch.glsl.
namespace voxray::path_trace {

/// Pixels along the edge of a square that shares its sequences: about what filter_irradiance reaches.
constexpr uint32_t kSharedEdge = 64;

/// Points of a half's sequence that each pixel takes, a power of two, where pixels share sequences; else 0.
inline uint32_t pointsOfPixel(const PathTraceOptions& options) {
    if (options.stratifiedOver == StratifiedOver::Pixel) return 0;
    return std::bit_ceil(options.spp > 1 ? (options.spp + 1) / 2 : 1);
}

/// Moves the low 16 bits to the even bits.
constexpr uint32_t spreadBits(uint32_t x) {
    x = (x | (x << 8)) & 0x00ff00ffu;
    x = (x | (x << 4)) & 0x0f0f0f0fu;
    x = (x | (x << 2)) & 0x33333333u;
    return (x | (x << 1)) & 0x55555555u;
}

/// Points of a pixel's samples: of sequences of its own, or of those that a square of pixels shares. There pixels in
/// Morton order take consecutive runs, so that the samples of any aligned square of 2ⁿ × 2ⁿ pixels are stratified
/// (Ahmed and Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of
/// Pixels").
class PixelPoints {
 public:
    /// @param points pointsOfPixel().
    PixelPoints(glm::uvec2 pixel, uint32_t width, uint32_t points, uint32_t seed) {
        if (points == 0) {
            seed_ = hashOf(seed, pixel.y * width + pixel.x);
            return;
        }
        const glm::uvec2 square = pixel / kSharedEdge, within = pixel % kSharedEdge;
        seed_ = hashOf(seed, square.y * width + square.x);
        first_ = (spreadBits(within.x) | (spreadBits(within.y) << 1)) * points;
    }

    /// @param half of the samples. @param index of the sample among those of its half.
    SobolSampler sampler(uint32_t half, uint32_t index) const {
        return SobolSampler(hashOf(seed_, half), first_ + index);
    }

 private:
    uint32_t seed_, first_ = 0;
};

}  // namespace voxray::path_trace
