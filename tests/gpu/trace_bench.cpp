#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <map>

#include "base/error.h"
#include "gpu/trace_scenes.h"
#include "scene/load.h"
#include "tests/support/places.h"
#include "trace/embree_scene.h"
#include "trace/ray_tracer.h"

namespace voxray {
namespace {

constexpr uint32_t kRays = 1u << 20;

/// A scene with a million incoherent rays inside its bounds and what Embree says of them.
struct Workload {
    SceneState state;
    std::vector<Ray> rays;
    std::vector<Hit> expected;
};

Workload load(const std::string& file) {
    Workload work{evaluate(loadGltf(test::scenesFolder() / file), 0.0), {}, std::vector<Hit>(kRays)};
    const glm::vec3 low = work.state.geometry.boundsMin, high = work.state.geometry.boundsMax;
    TestRandom random(1);
    const float infinity = std::numeric_limits<float>::infinity();
    for (uint32_t i = 0; i < kRays; ++i) {
        const glm::vec3 origin = glm::mix(low, high, random.vector(0, 1));
        const glm::vec3 target = glm::mix(low, high, random.vector(0, 1));
        work.rays.push_back({origin, 1e-4f, glm::normalize(target - origin), infinity});
    }
    EmbreeScene(work.state).closestHit(work.rays, work.expected);
    return work;
}

const Workload& workload(const std::string& file) {
    static std::map<std::string, Workload> loaded;
    const auto found = loaded.find(file);
    return found != loaded.end() ? found->second : loaded.emplace(file, load(file)).first->second;
}

/// Cosine between a ray and the normal of a triangle; 1 for a triangle without one.
double cosineAt(const Geometry& g, const Ray& ray, uint32_t triangle) {
    const glm::uvec3 v = g.triangles[triangle];
    const glm::dvec3 a = g.positions[v.x];
    const glm::dvec3 normal = glm::cross(glm::dvec3(g.positions[v.y]) - a, glm::dvec3(g.positions[v.z]) - a);
    const double length = glm::length(normal);
    return length > 0 ? std::abs(glm::dot(normal, glm::dvec3(ray.direction))) / length : 1.0;
}

/// Agreement with Embree: the fraction of rays with the same triangle (or a miss in both), the number with
/// another triangle at the same distance (shared edges, coincident triangles), the rest, and the largest
/// relative difference of t among the first. A ray that grazes its triangle meets it at a distance that
/// rounding moves by 1 / cos: `off_plane` is the largest difference of t times that cosine, how far one hit
/// lies off the other's plane, in metres.
void compare(benchmark::State& state, const Workload& work, const std::vector<Hit>& hits) {
    const std::vector<Hit>& expected = work.expected;
    size_t same = 0, ties = 0, far = 0;
    double worst = 0, offPlane = 0, farT = 0;
    for (size_t i = 0; i < expected.size(); ++i) {
        const bool isMiss = expected[i].triangle == Hit::kMiss;
        const double difference = isMiss ? 0.0 : std::abs(double(hits[i].t) - expected[i].t) / double(expected[i].t);
        if (hits[i].triangle == expected[i].triangle) {
            ++same;
            worst = std::max(worst, difference);
            if (isMiss) continue;
            const double cosine = cosineAt(work.state.geometry, work.rays[i], expected[i].triangle);
            offPlane = std::max(offPlane, difference * double(expected[i].t) * cosine);
            if (difference > 1e-4) {
                ++far;
                farT = std::max(farT, double(expected[i].t));
            }
        } else if (!isMiss && hits[i].triangle != Hit::kMiss && difference < 1e-4) {
            ++ties;
        }
    }
    const double count = double(expected.size());
    state.counters["same_percent"] = 100.0 * double(same) / count;
    state.counters["ties"] = double(ties);
    state.counters["others"] = count - double(same + ties);
    state.counters["t_difference"] = worst;
    state.counters["t_above_1e-4"] = double(far);
    state.counters["their_largest_t"] = farT;
    state.counters["off_plane"] = offPlane;
}

void trace(benchmark::State& state, const std::string& file, TracerKind kind, bool occluded) {
    Device device;
    ShaderCompiler compiler(test::sourceRoot(), {});
    std::unique_ptr<RayTracer> tracer;
    try {
        const Workload& work = workload(file);
        tracer = makeRayTracer(kind, device, compiler, work.state);
        const Buffer rays(device, "rays", kRays * sizeof(Ray)), results(device, "results", kRays * sizeof(Hit));
        CommandStream stream(device);
        stream.upload(rays, work.rays);
        stream.finish();
        for (auto _ : state) {
            if (occluded)
                tracer->occluded(stream, rays, results, kRays);
            else
                tracer->closestHit(stream, rays, results, kRays);
            stream.finish();
        }
        state.counters["rays/s"] = benchmark::Counter(double(state.iterations()) * kRays, benchmark::Counter::kIsRate);
        state.counters["MiB"] = double(tracer->memoryBytes()) / double(1 << 20);
        if (!occluded) compare(state, work, stream.readAs<Hit>(results, kRays));
    } catch (const Error& error) {
        state.SkipWithError(error.what());
    }
}

#define VOXRAY_BENCH(scene, kind)                                                              \
    BENCHMARK_CAPTURE(trace, scene##_##kind##_closest, #scene ".glb", TracerKind::kind, false) \
        ->Unit(benchmark::kMillisecond)                                                        \
        ->UseRealTime();                                                                       \
    BENCHMARK_CAPTURE(trace, scene##_##kind##_occluded, #scene ".glb", TracerKind::kind, true) \
        ->Unit(benchmark::kMillisecond)                                                        \
        ->UseRealTime()

VOXRAY_BENCH(sponza, Embree);
VOXRAY_BENCH(sponza, RayQuery);
VOXRAY_BENCH(sponza, RayPipeline);
VOXRAY_BENCH(kitchen, Embree);
VOXRAY_BENCH(kitchen, RayQuery);
VOXRAY_BENCH(kitchen, RayPipeline);

}  // namespace
}  // namespace voxray
