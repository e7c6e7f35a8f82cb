// The light tree on the host: time to build it, to pick a light, and to tell a picked light's probability. Points at
// random in a hall, seen from its floor and ceiling.
#include <benchmark/benchmark.h>

#include <vector>

#include "scene/light_tree.h"
#include "scene/uniform_random.h"

namespace voxray {
namespace {

constexpr float kHalfWidth = 12, kHeight = 4;  // m
constexpr size_t kReceivers = 1 << 12;

std::vector<BoundedLight> lightsInHall(uint32_t count) {
    UniformRandom uniform(1);
    std::vector<BoundedLight> lights;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec3 place(uniform(-kHalfWidth, kHalfWidth), uniform(0.1f, 0.9f) * kHeight,
                              uniform(-kHalfWidth, kHalfWidth));
        lights.push_back(*boundedLight({.name = {}, .position = place}, i));
    }
    return lights;
}

/// Each is next to the one before, as vertices of neighboring paths are.
std::vector<LightTree::Receiver> receiversInHall() {
    constexpr size_t kNextTo = 16;
    UniformRandom uniform(2);
    std::vector<LightTree::Receiver> receivers;
    for (size_t i = 0; i < kReceivers; ++i) {
        const bool isFloor = i / kNextTo % 2 == 0;
        if (i % kNextTo > 0)
            receivers.push_back(receivers.back());
        else
            receivers.push_back(
                {{uniform(-kHalfWidth, kHalfWidth), isFloor ? 0 : kHeight, uniform(-kHalfWidth, kHalfWidth)},
                 {0, isFloor ? 1 : -1, 0}});
        receivers.back().position.x += uniform(0, 0.01f);
    }
    return receivers;
}

void lightTreeBuild(benchmark::State& state) {
    const std::vector<BoundedLight> lights = lightsInHall(uint32_t(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(LightTree(lights));
    const LightTree tree(lights);
    const double count = double(lights.size());
    state.counters["device_bytes_per_light"] = double(tree.nodes().size() * sizeof(gpu::LightTreeNode)) / count;
    state.counters["host_bytes_per_light"] = double(tree.memoryBytes()) / count;
}

void lightTreePick(benchmark::State& state) {
    const LightTree tree(lightsInHall(uint32_t(state.range(0))));
    const std::vector<LightTree::Receiver> receivers = receiversInHall();
    UniformRandom uniform(3);
    size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(tree.pick(receivers[i++ % kReceivers], uniform(0, 1)));
}

void lightTreeProbability(benchmark::State& state) {
    const LightTree tree(lightsInHall(uint32_t(state.range(0))));
    const std::vector<LightTree::Receiver> receivers = receiversInHall();
    UniformRandom uniform(3);
    std::vector<uint32_t> leaves;
    for (const LightTree::Receiver& to : receivers) leaves.push_back(tree.leaf(tree.pick(to, uniform(0, 1)).id));
    size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(tree.probability(leaves[i % kReceivers], receivers[i % kReceivers]));
        ++i;
    }
}

BENCHMARK(lightTreeBuild)->RangeMultiplier(10)->Range(10, 10'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(lightTreePick)->RangeMultiplier(10)->Range(10, 10'000);
BENCHMARK(lightTreeProbability)->RangeMultiplier(10)->Range(10, 10'000);

}  // namespace
}  // namespace voxray
