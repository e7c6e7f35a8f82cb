#include <benchmark/benchmark.h>

#include <cstdlib>
#include <ctime>
#include <vector>

#include "passes/path_trace/path_tracer.h"
#include "scene/load.h"

namespace voxray {
namespace {

/// CPU time of all threads: what a busy machine doesn't stretch.
double processSeconds() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

/// Renders `cornell`, a seed an iteration. Writes speed and the variance of one sample (mean over pixels and
/// channels of the spread between seeds, times spp), which cycles_compare.py reads:
///     bench_trace --benchmark_filter=pathTraceCornell --benchmark_out=ours.json --benchmark_out_format=json
/// Where $VOXRAY_EXPORT is set, the scene is written there as .glb.
void pathTraceCornell(benchmark::State& state) {
    const SceneState scene = evaluate(makeBuiltinScene("cornell", Value()), 0.0);
    if (const char* path = std::getenv("VOXRAY_EXPORT")) exportGlb(scene, path);
    const EmbreeScene tracer(scene);
    PathTraceOptions options{
        .width = 512, .height = 512, .spp = 32, .bounces = uint32_t(state.range(0)), .seed = 0};
    std::vector<double> sum(size_t(512) * 512 * 3), squares(sum.size());
    double samples = 0, rays = 0, mean = 0;
    double spent = 0;
    for (auto _ : state) {
        const double start = processSeconds();
        const PathTraceResult result = pathTrace(scene, tracer, scene.cameras.at(0), options);
        state.PauseTiming();
        ++options.seed;
        spent += processSeconds() - start;
        samples += double(options.width) * options.height * options.spp;
        rays += double(result.rays);
        for (size_t i = 0; i < sum.size(); ++i) {
            sum[i] += result.total.data[i];
            squares[i] += double(result.total.data[i]) * result.total.data[i];
            mean += result.total.data[i];
        }
        state.ResumeTiming();
    }
    const double seeds = double(options.seed);
    double spread = 0;
    for (size_t i = 0; i < sum.size(); ++i) spread += (squares[i] - sum[i] * sum[i] / seeds) / (seeds - 1);
    state.counters["samples_per_s"] = benchmark::Counter(samples, benchmark::Counter::kIsRate);
    state.counters["samples_per_cpu_s"] = samples / spent;
    state.counters["rays_per_cpu_s"] = rays / spent;
    state.counters["rays_per_sample"] = rays / samples;
    state.counters["sample_variance"] = spread / double(sum.size()) * options.spp;
    state.counters["mean"] = mean / seeds / double(sum.size());
}
BENCHMARK(pathTraceCornell)
    ->Arg(0)
    ->Arg(8)
    ->Arg(64)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(4);

}  // namespace
}  // namespace voxray
