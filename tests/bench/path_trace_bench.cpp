#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/sweep.h"
#include "experiment/scene_files.h"
#include "experiment/scene_setup.h"
#include "passes/path_trace/path_tracer.h"
#include "scene/gltf_sidecar.h"
#include "scene/load.h"
#include "tests/support/places.h"

namespace voxray {
namespace {

constexpr uint32_t kSpp = 32;

/// CPU time of all threads: what a busy machine doesn't stretch.
double processSeconds() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

/// Renders a scene through its first camera, a seed an iteration. Writes speed and the variance of one sample
/// (mean over pixels and channels of the spread between seeds, times spp), and what was rendered.
void renderSeeds(benchmark::State& state, const SceneState& scene, PathTraceOptions options) {
    const EmbreeScene tracer(scene);
    std::vector<double> sum(size_t(options.width) * options.height * 3), squares(sum.size());
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
    state.counters["width"] = options.width;
    state.counters["height"] = options.height;
    state.counters["bounces"] = options.bounces;
    state.counters["spp"] = options.spp;
}

void pathTraceCornell(benchmark::State& state) {
    renderSeeds(state, evaluate(makeBuiltinScene("cornell", Value()), 0.0),
                {.width = 512, .height = 512, .spp = kSpp, .bounces = uint32_t(state.range(0))});
}

/// A scene of configs/bench/rivals_still_light.yaml, with the config's image and its reference's bounces. Where
/// $VOXRAY_EXPORT names a folder, the scene is written there as .glb, for cycles_compare.py.
void pathTraceRival(benchmark::State& state, const std::string& scene) {
    try {
        const std::filesystem::path file = test::sourceRoot() / "configs/bench/rivals_still_light.yaml";
        const Experiment config = loadExperiment(file);
        const Value& axis = *config.sweep.find("scene");
        const std::vector<std::string> labels = sweepLabels("scene", axis, {});
        const auto place = std::find(labels.begin(), labels.end(), scene);
        if (place == labels.end()) throw Error("{} has no scene '{}'", file.string(), scene);
        const Value chosen = sweepValues(axis)[size_t(place - labels.begin())];
        SceneLoader loader(sceneFolders({}, test::sourceRoot(), file));
        const SceneState prepared = loader.prepare(readSceneSettings(chosen)).state;

        const ImageSettings& image = config.setup.image;
        if (const char* folder = std::getenv("VOXRAY_EXPORT"))
            exportForRenderers(prepared, {prepared.cameras.at(0), image.width, image.height, image.exposureStops},
                               std::filesystem::path(folder) / (scene + ".glb"), {});
        state.SetLabel(scene);
        const int64_t bounces = config.reference.find("bounces")->asInteger("reference.bounces");
        renderSeeds(state, prepared,
                    {.width = image.width, .height = image.height, .spp = kSpp, .bounces = uint32_t(bounces)});
    } catch (const Error& error) {
        state.SkipWithError(error.what());
    }
}

BENCHMARK(pathTraceCornell)->Arg(0)->Arg(8)->Arg(64)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(4);
BENCHMARK_CAPTURE(pathTraceRival, cornell, "cornell")->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(4);
BENCHMARK_CAPTURE(pathTraceRival, sponza, "sponza")->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(4);
BENCHMARK_CAPTURE(pathTraceRival, dining_room, "dining_room")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(4);

}  // namespace
}  // namespace voxray
