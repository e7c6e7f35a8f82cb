#include <benchmark/benchmark.h>

#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "tests/gpu/chain.h"
#include "tests/support/places.h"

namespace voxray {
namespace {

/// Sponza under a spot light as in configs/papers/magalhaes2020/output_resolution.yaml.
std::unique_ptr<test::Chain> sponza(uint32_t width, uint32_t height) {
    const auto scene = std::make_shared<SceneState>(evaluate(loadGltf(test::scenesFolder() / "sponza.glb"), 0.0));
    Camera camera;
    camera.position = {-9, 1.2f, -0.3f};
    camera.forward = glm::normalize(glm::vec3(9, 1.8f, 0.3f));
    camera.up = glm::normalize(glm::cross(glm::cross(camera.forward, {0, 1, 0}), camera.forward));
    scene->cameras = {camera};
    Light spot;
    spot.type = LightType::Spot;
    spot.position = {0, 9, 0};
    spot.direction = glm::normalize(glm::vec3(0, -1, 0.1f));
    spot.intensity = glm::vec3(400);
    spot.innerConeAngle = glm::radians(30.0f);
    spot.outerConeAngle = glm::radians(45.0f);
    scene->lights = {spot};
    return std::make_unique<test::Chain>(scene,
                                         test::graphYaml({"gbuffer", "voxelize, resolution: 128",
                                                          "inject_light_rays, rays_per_light: 1048576, secondary: none",
                                                          "gather_irradiance, light: direct", "composite"}),
                                         width, height, 1);
}

struct Cost {
    double cpuSeconds;    ///< Of all threads.
    double milliseconds;  ///< Of the pass, by its time stamps.
};

Cost inject(test::Chain& chain) {
    const std::clock_t begin = std::clock();
    chain.relight();
    return {double(std::clock() - begin) / CLOCKS_PER_SEC, chain.buildSamples.back().milliseconds};
}

/// Injection with a large image over the same with a small one: medians of the ratios of neighboring
/// runs, the first of which is now the one, now the other, so that what else the machine does falls on both.
void injectionResolution(benchmark::State& state) {
    const auto small = sponza(320, 180), large = sponza(1280, 720);
    std::vector<double> cpu, time;
    bool smallFirst = false;
    for (auto _ : state) {
        smallFirst = !smallFirst;
        Cost s{}, l{};
        if (smallFirst) s = inject(*small);
        l = inject(*large);
        if (!smallFirst) s = inject(*small);
        cpu.push_back(l.cpuSeconds / s.cpuSeconds);
        time.push_back(l.milliseconds / s.milliseconds);
    }
    for (const auto& [name, ratios] : {std::pair{"cpu", cpu}, std::pair{"time", time}}) {
        const Percentiles p = percentiles(ratios);
        state.counters[std::string(name) + "_ratio"] = p.median;
        state.counters[std::string(name) + "_p05"] = p.p05;
        state.counters[std::string(name) + "_p95"] = p.p95;
    }
}
BENCHMARK(injectionResolution)->MeasureProcessCPUTime()->Iterations(40)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxray
