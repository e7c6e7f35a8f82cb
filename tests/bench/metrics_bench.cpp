#include <benchmark/benchmark.h>

#include <cmath>

#include "image/metrics.h"

namespace voxray {
namespace {

/// Waves of radiance from 0.01 to 100, with a shift that makes an error.
ImageF waves(uint32_t width, uint32_t height, float shift) {
    ImageF image(width, height, 3);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
            for (uint32_t c = 0; c < 3; ++c)
                image.pixel(x, y)[c] =
                    std::pow(10.0f, 2 * std::sin(0.05f * float(x) + shift) * std::cos(0.03f * float(y * (c + 1))));
    return image;
}

/// HDR-FLIP over the published choice of exposures; `Mpixel/s` counts image pixels, whatever the exposures.
void flipHdrOfImage(benchmark::State& state) {
    const auto width = uint32_t(state.range(0)), height = uint32_t(state.range(1));
    const ImageF reference = waves(width, height, 0), test = waves(width, height, 0.1f);
    const FlipExposures exposures = flipExposures(reference);
    for (auto _ : state) benchmark::DoNotOptimize(flipHdr(test, reference, exposures).mean);
    state.counters["exposures"] = exposures.count;
    state.counters["Mpixel/s"] =
        benchmark::Counter(double(state.iterations()) * width * height * 1e-6, benchmark::Counter::kIsRate);
}
BENCHMARK(flipHdrOfImage)->Args({640, 360})->Args({1920, 1080})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace voxray
