#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <limits>
#include <random>
#include <vector>

#include "base/parallel.h"
#include "scene/load.h"
#include "tests/support/places.h"
#include "trace/embree_api.h"
#include "trace/embree_scene.h"

namespace voxray {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr size_t kRays = 1 << 20;
constexpr size_t kGrain = 4096;

std::filesystem::path sponzaPath() {
    return test::scenesFolder() / "sponza.glb";
}

/// A scene with all alpha masks off: the bare loop has no filter.
SceneState opaqueState(const Scene& scene) {
    auto opaque = std::make_shared<Scene>(scene);
    for (Material& m : opaque->materials) m.alphaMode = AlphaMode::Opaque;
    return evaluate(opaque, 0.0);
}

/// Rays from random places in the center of the scene into random directions: incoherent, as gather rays are.
std::vector<Ray> incoherentRays(const Geometry& geometry) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    const glm::vec3 size = geometry.boundsMax - geometry.boundsMin;
    std::vector<Ray> rays(kRays);
    for (Ray& ray : rays) {
        for (int i = 0; i < 3; ++i) ray.origin[i] = geometry.boundsMin[i] + size[i] * (0.2f + 0.6f * unit(random));
        const float z = 2 * unit(random) - 1, phi = 6.2831853f * unit(random), r = std::sqrt(1 - z * z);
        ray.direction = {r * std::cos(phi), r * std::sin(phi), z};
        ray.tMin = 0;
        ray.tMax = kInfinity;
    }
    return rays;
}

/// Embree used directly, with the same flags: what the streams are measured against.
class BareScene {
 public:
    explicit BareScene(const Geometry& geometry) {
        device_ = rtcNewDevice(nullptr);
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
        RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        std::memcpy(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                            geometry.positions.size()),
                    geometry.positions.data(), geometry.positions.size() * sizeof(glm::vec3));
        std::memcpy(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                            geometry.triangles.size()),
                    geometry.triangles.data(), geometry.triangles.size() * sizeof(glm::uvec3));
        rtcSetGeometryBuildQuality(mesh, RTC_BUILD_QUALITY_HIGH);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene_, mesh);
        rtcReleaseGeometry(mesh);
        rtcCommitScene(scene_);
    }
    ~BareScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    BareScene(const BareScene&) = delete;
    BareScene& operator=(const BareScene&) = delete;

    template <bool kOccluded>
    void trace(std::vector<RTCRayHit>& queries) const {
        parallelRanges(queries.size(), kGrain, [&](size_t begin, size_t end) {
            EmbreeQuery embree(Coherence::Incoherent);
            for (size_t i = begin; i < end; ++i) {
                if constexpr (kOccluded)
                    embree.occluded(scene_, queries[i].ray);
                else
                    embree.intersect(scene_, queries[i]);
            }
        });
    }

 private:
    RTCDevice device_;
    RTCScene scene_;
};

std::vector<RTCRayHit> prepared(const std::vector<Ray>& rays) {
    std::vector<RTCRayHit> queries(rays.size());
    for (size_t i = 0; i < rays.size(); ++i) {
        const Ray& r = rays[i];
        queries[i].ray = {
            r.origin.x, r.origin.y,  r.origin.z, r.tMin, r.direction.x, r.direction.y, r.direction.z, 0.0f,
            r.tMax,     0xffffffffu, 0,          0};
        queries[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
    }
    return queries;
}

/// CPU time of all threads: what a busy machine doesn't stretch.
template <typename F>
double secondsOf(const F& f) {
    const std::clock_t start = std::clock();
    f();
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Alternates between both, so that a busy machine slows both alike; `ratio` is the median of the pairs'
/// ratios, rays a second are those of a second of CPU time.
template <bool kOccluded>
void streamAgainstBareLoop(benchmark::State& state, const Scene& source) {
    const SceneState scene = opaqueState(source);
    const EmbreeScene tracer(scene);
    const BareScene bare(scene.geometry);
    const std::vector<Ray> rays = incoherentRays(scene.geometry);
    const std::vector<RTCRayHit> queries = prepared(rays);
    std::vector<RTCRayHit> results = queries;
    std::vector<Hit> hits(rays.size());
    std::vector<uint32_t> occluded(rays.size());
    std::vector<double> ratios;
    double bareBest = 1e30, streamBest = 1e30;
    for (auto _ : state) {
        results = queries;
        const double bareSeconds = secondsOf([&] { bare.trace<kOccluded>(results); });
        const double streamSeconds = secondsOf([&] {
            if constexpr (kOccluded)
                tracer.occluded(rays, occluded);
            else
                tracer.closestHit(rays, hits);
        });
        ratios.push_back(bareSeconds / streamSeconds);
        bareBest = std::min(bareBest, bareSeconds);
        streamBest = std::min(streamBest, streamSeconds);
        state.SetIterationTime(streamSeconds);
    }
    for (size_t i = 0; i < rays.size(); ++i) {
        const bool equal = kOccluded ? (results[i].ray.tfar < 0.0f) == (occluded[i] == 1)
                           : results[i].hit.geomID == RTC_INVALID_GEOMETRY_ID
                               ? hits[i].triangle == Hit::kMiss
                               : hits[i].triangle == results[i].hit.primID;
        if (!equal) return state.SkipWithError("stream and bare loop disagree");
    }
    std::sort(ratios.begin(), ratios.end());
    state.counters["ratio"] = ratios[ratios.size() / 2];
    state.counters["best_ratio"] = bareBest / streamBest;
    state.counters["bare_Mray/s"] = double(rays.size()) / bareBest * 1e-6;
    state.counters["stream_Mray/s"] = double(rays.size()) / streamBest * 1e-6;
}

/// Rays of a camera in the center of the scene, row by row; the image spans 60 degrees upright.
std::vector<Ray> cameraRays(const Geometry& geometry) {
    constexpr uint32_t kWidth = 640, kHeight = 360;
    const float up = std::tan(glm::radians(30.0f)), right = up * kWidth / kHeight;
    std::vector<Ray> rays(kWidth * kHeight);
    for (uint32_t i = 0; i < rays.size(); ++i) {
        const float x = 2 * (float(i % kWidth) + 0.5f) / kWidth - 1;
        const float y = 1 - 2 * (float(i / kWidth) + 0.5f) / kHeight;
        rays[i] = {0.5f * (geometry.boundsMin + geometry.boundsMax), 0, glm::normalize(glm::vec3(1, up * y, right * x)),
                   kInfinity};
    }
    return rays;
}

/// Packets against single rays, alternately; `ratio` is the median of the pairs' ratios of time.
void sponzaCameraRays(benchmark::State& state) {
    if (!std::filesystem::exists(sponzaPath())) return state.SkipWithError("sponza.glb not found");
    const SceneState scene = evaluate(loadGltf(sponzaPath()), 0.0);
    const EmbreeScene tracer(scene);
    const std::vector<Ray> rays = cameraRays(scene.geometry);
    std::vector<Hit> apart(rays.size()), together(rays.size());
    std::vector<double> ratios;
    for (auto _ : state) {
        const double apartSeconds = secondsOf([&] { tracer.closestHit(rays, apart); });
        const double seconds = secondsOf([&] { tracer.closestHit(rays, together, Coherence::Coherent); });
        ratios.push_back(seconds / apartSeconds);
        state.SetIterationTime(seconds);
    }
    size_t different = 0;
    for (size_t i = 0; i < rays.size(); ++i) different += apart[i].triangle != together[i].triangle;
    std::sort(ratios.begin(), ratios.end());
    state.counters["ratio"] = ratios[ratios.size() / 2];
    state.counters["other_triangle"] = double(different) / double(rays.size());
}

void cornellClosest(benchmark::State& state) {
    streamAgainstBareLoop<false>(state, *makeBuiltinScene("cornell", Value()));
}
void cornellOccluded(benchmark::State& state) {
    streamAgainstBareLoop<true>(state, *makeBuiltinScene("cornell", Value()));
}
void sponzaClosest(benchmark::State& state) {
    if (!std::filesystem::exists(sponzaPath())) return state.SkipWithError("sponza.glb not found");
    streamAgainstBareLoop<false>(state, *loadGltf(sponzaPath()));
}
void sponzaOccluded(benchmark::State& state) {
    if (!std::filesystem::exists(sponzaPath())) return state.SkipWithError("sponza.glb not found");
    streamAgainstBareLoop<true>(state, *loadGltf(sponzaPath()));
}
BENCHMARK(sponzaCameraRays)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(15);
BENCHMARK(cornellClosest)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(15);
BENCHMARK(cornellOccluded)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(15);
BENCHMARK(sponzaClosest)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(15);
BENCHMARK(sponzaOccluded)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(15);

}  // namespace
}  // namespace voxray
