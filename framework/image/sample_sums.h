#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "image/image.h"

namespace voxray {

/// One of `parts` disjoint ranges of an image's samples per pixel, whose sizes differ by at most one.
struct SamplePart {
    uint32_t index = 0;
    uint32_t parts = 1;

    /// Index of the first sample, of `samples` in total.
    uint64_t first(uint64_t samples) const { return samples * index / parts; }
    /// Index after the last sample.
    uint64_t end(uint64_t samples) const { return samples * (index + 1) / parts; }
};

/// Sums over samples of an image, in double: those of parts add up to those of the full image.
struct SampleSums {
    uint32_t width = 0;
    uint32_t height = 0;
    uint64_t samples = 0;      ///< Per pixel.
    std::vector<double> data;  ///< Row by row, 3 channels, W/(m² sr).

    SampleSums() = default;
    SampleSums(uint32_t w, uint32_t h, uint64_t n) : width(w), height(h), samples(n), data(size_t(w) * h * 3) {}

    double* pixel(uint32_t x, uint32_t y) { return &data[(size_t(y) * width + x) * 3]; }

    /// Adds sums of an image of the same size.
    void add(const SampleSums& other) {
        samples += other.samples;
        for (size_t i = 0; i < data.size(); ++i) data[i] += other.data[i];
    }
    /// The image; black without samples.
    ImageF mean() const {
        ImageF image(width, height, 3);
        for (size_t i = 0; i < data.size(); ++i)
            image.data[i] = float(data[i] / double(std::max(samples, uint64_t(1))));
        return image;
    }
};

}  // namespace voxray
