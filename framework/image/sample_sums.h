#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "image/image.h"

namespace voxray {

/// A part of an image's samples, which are numbered from 0: one of `parts` ranges of these numbers, disjoint,
/// of sizes that differ by one at most.
struct SamplePart {
    uint32_t index = 0;
    uint32_t parts = 1;

    /// The first sample's number, of `samples` in all parts together.
    uint64_t first(uint64_t samples) const { return samples * index / parts; }
    /// One more than the last sample's number.
    uint64_t end(uint64_t samples) const { return samples * (index + 1) / parts; }
};

/// Sums over samples of an image, in double: what is rendered in parts adds up to what is rendered at once.
struct SampleSums {
    uint32_t width = 0;
    uint32_t height = 0;
    uint64_t samples = 0;      ///< Of each pixel.
    std::vector<double> data;  ///< Row by row, 3 channels, W/(m² sr).

    SampleSums() = default;
    SampleSums(uint32_t w, uint32_t h, uint64_t n)
        : width(w), height(h), samples(n), data(size_t(w) * h * 3) {}

    double* pixel(uint32_t x, uint32_t y) { return &data[(size_t(y) * width + x) * 3]; }

    /// Adds other samples of an image of the same size.
    void add(const SampleSums& other) {
        samples += other.samples;
        for (size_t i = 0; i < data.size(); ++i) data[i] += other.data[i];
    }
    /// The image; black where there is no sample.
    ImageF mean() const {
        ImageF image(width, height, 3);
        for (size_t i = 0; i < data.size(); ++i)
            image.data[i] = float(data[i] / double(std::max(samples, uint64_t(1))));
        return image;
    }
};

}  // namespace voxray
