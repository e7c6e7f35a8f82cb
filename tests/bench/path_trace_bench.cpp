#include <benchmark/benchmark.h>

#include "passes/path_trace/path_tracer.h"
#include "scene/load.h"

namespace voxray {
namespace {

void pathTraceCornell(benchmark::State& state) {
    const SceneState scene = evaluate(makeBuiltinScene("cornell", Value()), 0.0);
    const EmbreeScene tracer(scene);
    const PathTraceOptions options{
        .width = 512, .height = 512, .spp = 8, .bounces = uint32_t(state.range(0)), .seed = 1};
    double paths = 0, rays = 0;
    for (auto _ : state) {
        const PathTraceResult result = pathTrace(scene, tracer, scene.cameras.at(0), options);
        paths += double(options.width) * options.height * options.spp;
        rays += double(result.rays);
    }
    state.counters["samples/s"] = benchmark::Counter(paths, benchmark::Counter::kIsRate);
    state.counters["rays/s"] = benchmark::Counter(rays, benchmark::Counter::kIsRate);
    state.counters["rays/sample"] = rays / paths;
}
BENCHMARK(pathTraceCornell)->Arg(0)->Arg(8)->Arg(64)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace voxray
