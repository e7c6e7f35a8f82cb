// The device's building blocks against the standard library on the host, 2^24 keys, same answers.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>
#include <random>

#include "passes/common/compute/compaction.h"
#include "passes/common/compute/radix_sort.h"
#include "tests/support/programs.h"

namespace voxray {
namespace {

constexpr uint32_t kCount = 1u << 24;

std::vector<uint32_t> randomKeys() {
    std::mt19937 random(1);
    std::vector<uint32_t> keys(kCount);
    for (uint32_t& key : keys) key = random();
    return keys;
}

/// The keys on the device.
struct OnDevice {
    Device& device = test::device();
    test::TestPrograms programs;
    CommandStream stream{device};
    std::vector<uint32_t> keys = randomKeys();
    Buffer buffer{device, "keys", uint64_t(kCount) * sizeof(uint32_t)};
    OnDevice() { stream.upload(buffer, keys); }
};

void report(benchmark::State& state) {
    state.counters["Mkey/s"] =
        benchmark::Counter(double(state.iterations()) * kCount * 1e-6, benchmark::Counter::kIsRate);
}

/// Bits set in the words before each.
void scanOnHost(const std::vector<uint32_t>& words, std::vector<uint32_t>& before) {
    std::transform_exclusive_scan(words.begin(), words.end(), before.begin(), 0u, std::plus<>(),
                                  [](uint32_t word) { return uint32_t(std::popcount(word)); });
}

/// The indices of the set bits of the first kCount. @return their number.
size_t compactOnHost(const std::vector<uint32_t>& words, std::vector<uint32_t>& indices) {
    size_t count = 0;
    for (uint32_t i = 0; i < kCount; ++i)
        if (words[i / 32] >> (i % 32) & 1u) indices[count++] = i;
    return count;
}

void computeScanOnDevice(benchmark::State& state) {
    OnDevice d;
    const PrefixSum prefixSum(d.programs, PrefixSum::Input::SetBits);
    d.programs.compile();
    const Buffer before(d.device, "before", d.buffer.bytes());
    prefixSum.run(d.stream, d.buffer, before, kCount);  // The driver compiles programs when they first run.
    for (auto _ : state) benchmark::DoNotOptimize(prefixSum.run(d.stream, d.buffer, before, kCount));
    std::vector<uint32_t> expected(kCount);
    scanOnHost(d.keys, expected);
    if (d.stream.readAs<uint32_t>(before, kCount) != expected) state.SkipWithError("the sums differ");
    report(state);
}
BENCHMARK(computeScanOnDevice)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void computeScanOnHost(benchmark::State& state) {
    const std::vector<uint32_t> keys = randomKeys();
    std::vector<uint32_t> before(kCount);
    for (auto _ : state) {
        scanOnHost(keys, before);
        benchmark::DoNotOptimize(before.back());
    }
    report(state);
}
BENCHMARK(computeScanOnHost)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void computeCompactOnDevice(benchmark::State& state) {
    OnDevice d;
    const Compaction compaction(d.programs);
    d.programs.compile();
    const Buffer indices(d.device, "indices", d.buffer.bytes());
    // kCount items, half of them flagged.
    uint32_t count = compaction.run(d.stream, d.buffer, indices, kCount / 32);
    for (auto _ : state) count = compaction.run(d.stream, d.buffer, indices, kCount / 32);
    std::vector<uint32_t> expected(kCount);
    expected.resize(compactOnHost(d.keys, expected));
    if (d.stream.readAs<uint32_t>(indices, count) != expected) state.SkipWithError("the indices differ");
    report(state);
}
BENCHMARK(computeCompactOnDevice)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void computeCompactOnHost(benchmark::State& state) {
    const std::vector<uint32_t> words = randomKeys();
    std::vector<uint32_t> indices(kCount);
    for (auto _ : state) benchmark::DoNotOptimize(compactOnHost(words, indices));
    report(state);
}
BENCHMARK(computeCompactOnHost)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void computeSortOnDevice(benchmark::State& state) {
    OnDevice d;
    RadixSort sort(d.programs);
    d.programs.compile();
    std::vector<uint32_t> order(kCount);
    std::iota(order.begin(), order.end(), 0u);
    Buffer values(d.device, "values", d.buffer.bytes());
    sort.record(d.stream, d.buffer, values, kCount);
    for (auto _ : state) {
        state.PauseTiming();
        d.stream.upload(d.buffer, d.keys);
        d.stream.upload(values, order);
        d.stream.finish();
        state.ResumeTiming();
        sort.record(d.stream, d.buffer, values, kCount);
        d.stream.finish();
    }
    if (std::vector<uint32_t> sorted = d.keys;
        std::ranges::sort(sorted), d.stream.readAs<uint32_t>(d.buffer, kCount) != sorted)
        state.SkipWithError("the keys are not sorted");
    report(state);
}
BENCHMARK(computeSortOnDevice)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// Pairs of key and value, as on the device.
void computeSortOnHost(benchmark::State& state) {
    const std::vector<uint32_t> keys = randomKeys();
    std::vector<std::pair<uint32_t, uint32_t>> pairs(kCount);
    for (auto _ : state) {
        state.PauseTiming();
        for (uint32_t i = 0; i < kCount; ++i) pairs[i] = {keys[i], i};
        state.ResumeTiming();
        std::ranges::stable_sort(pairs, {}, [](const auto& pair) { return pair.first; });
    }
    report(state);
}
BENCHMARK(computeSortOnHost)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
}  // namespace voxray
