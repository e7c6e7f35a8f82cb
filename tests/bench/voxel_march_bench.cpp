#include <benchmark/benchmark.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "passes/common/voxel_march/voxel_tracer.h"
#include "tests/bench/sponza.h"
#include "tests/gpu/prepared.h"

namespace voxray {
namespace {

/// A point on a surface, uniform over area, and the surface's normal.
struct SurfacePoint {
    glm::vec3 position, normal;
};

class SurfacePoints {
 public:
    explicit SurfacePoints(const Geometry& geometry) : geometry_(geometry) {
        for (const glm::uvec3& t : geometry.triangles) {
            const glm::vec3 a = geometry.positions[t.x];
            area_.push_back(glm::length(glm::cross(geometry.positions[t.y] - a, geometry.positions[t.z] - a)));
        }
        pick_ = std::discrete_distribution<size_t>(area_.begin(), area_.end());
    }
    SurfacePoint next() {
        const glm::uvec3& t = geometry_.triangles[pick_(random_)];
        const glm::vec3 a = geometry_.positions[t.x], b = geometry_.positions[t.y], c = geometry_.positions[t.z];
        float u = uniform_(random_), v = uniform_(random_);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        return {a + u * (b - a) + v * (c - a), glm::normalize(glm::cross(b - a, c - a))};
    }

 private:
    const Geometry& geometry_;
    std::vector<double> area_;
    std::discrete_distribution<size_t> pick_;
    std::mt19937 random_{1};
    std::uniform_real_distribution<float> uniform_{0, 1};
};

/// Shadow rays between random points of surfaces, each moved a voxel's diagonal off its surface towards the
/// other.
std::vector<Ray> shadowRays(const Geometry& geometry, float voxelSize, uint32_t count) {
    SurfacePoints points(geometry);
    const auto moved = [&](const SurfacePoint& from, const SurfacePoint& to) {
        const float side = glm::dot(from.normal, to.position - from.position) > 0 ? 1.0f : -1.0f;
        return from.position + side * 1.7320508f * voxelSize * from.normal;
    };
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        const SurfacePoint a = points.next(), b = points.next();
        const glm::vec3 from = moved(a, b), to = moved(b, a);
        ray = {from, 0, to - from, 1};
    }
    return rays;
}

/// Visibility between random surface points of Sponza by every walk, one after another in each iteration:
/// rays a second of CPU time, steps and visits a ray, how much faster the faster walks are, and what each
/// builds besides the voxels.
void voxelMarch(benchmark::State& state) {
    constexpr uint32_t kRays = 1u << 19;
    constexpr size_t kWalks = EnumNames<VoxelTraversal>::names.size();
    test::Chain& chain = sponza(uint32_t(state.range(0)));
    const SurfaceVoxels& voxels = *chain.graph().resource<SurfaceVoxels>("voxels");
    CommandStream stream(test::device());
    const Buffer rays(test::device(), "rays", kRays * sizeof(Ray));
    stream.upload(rays, shadowRays(chain.state().geometry, voxels.grid.voxelSize, kRays));
    const Buffer results(test::device(), "results", kRays * sizeof(uint32_t));

    // Once each outside of the measurement: structures are built, answers compared.
    test::TestPrograms programs;
    std::vector<std::unique_ptr<VoxelTracer>> tracers;
    std::vector<uint32_t> first;
    for (const auto& [walk, name] : EnumNames<VoxelTraversal>::names) {
        VoxelTracer& tracer = *tracers.emplace_back(std::make_unique<VoxelTracer>(programs, walk));
        test::prepare(programs, tracer, voxels);
        const double begin = cpuSeconds();
        tracer.begin(stream, voxels);
        stream.finish();
        state.counters[std::string(name) + "_build_ms"] = 1e3 * (cpuSeconds() - begin);
        state.counters[std::string(name) + "_KiB"] = double(tracer.memoryBytes()) / 1024;
        tracer.occluded(stream, rays, results, kRays);
        const std::vector<uint32_t> answers = stream.readAs<uint32_t>(results, kRays);
        if (first.empty()) first = answers;
        if (answers != first) return state.SkipWithError("the walks disagree");
        const std::vector<uint64_t> counts = stream.readAs<uint64_t>(tracer.march().counts(), 2);
        state.counters[std::string(name) + "_steps"] = double(counts[0]) / kRays;
        state.counters[std::string(name) + "_visits"] = double(counts[1]) / kRays;
    }
    state.counters["occluded"] = double(std::reduce(first.begin(), first.end(), uint64_t(0))) / kRays;

    std::array<double, kWalks> seconds{};
    for (auto _ : state)
        for (size_t walk = 0; walk < kWalks; ++walk) {
            const double begin = cpuSeconds();
            tracers[walk]->occluded(stream, rays, results, kRays);
            stream.finish();
            seconds[walk] += cpuSeconds() - begin;
        }
    for (size_t walk = 0; walk < kWalks; ++walk)
        state.counters[std::string(EnumNames<VoxelTraversal>::names[walk].second) + "_Mrays_s"] =
            double(state.iterations()) * kRays / 1e6 / seconds[walk];
    const auto over = [&](VoxelTraversal a, VoxelTraversal b) { return seconds[size_t(b)] / seconds[size_t(a)]; };
    state.counters["bricks_over_bits"] = over(VoxelTraversal::Bricks, VoxelTraversal::Bits);
    state.counters["svo_over_svo_restart"] = over(VoxelTraversal::Svo, VoxelTraversal::SvoRestart);
}
BENCHMARK(voxelMarch)
    ->ArgName("resolution")
    ->Arg(256)
    ->MeasureProcessCPUTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxray
