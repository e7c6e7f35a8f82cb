// A BVH over the boxes of occupied voxels against one over triangles (Magalhães 2020, section 3.3.3.2): what
// building and tracing cost, and how far off rays end.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "base/parallel.h"
#include "scene/load.h"
#include "tests/bench/sponza.h"
#include "tests/physics/voxels_read.h"
#include "tests/support/places.h"
#include "trace/embree_api.h"
#include "trace/embree_scene.h"

namespace voxray {
namespace {

constexpr size_t kRays = 1 << 20, kGrain = 4096;
constexpr float kFar = 1e30f;

/// The boxes of occupied voxels in Embree: its builder with its own callbacks for boxes, of the quality that
/// triangles get. A ray that starts in a box meets it where it starts.
class BoxScene {
 public:
    BoxScene(const gpu::VoxelGrid& grid, const std::vector<glm::ivec3>& voxels) : grid_(grid), voxels_(voxels) {
        device_ = rtcNewDevice(nullptr);
        scene_ = rtcNewScene(device_);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
        RTCGeometry boxes = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(boxes, unsigned(voxels.size()));
        rtcSetGeometryUserData(boxes, this);
        rtcSetGeometryBoundsFunction(boxes, bounds, nullptr);
        rtcSetGeometryIntersectFunction(boxes, intersect);
        rtcSetGeometryBuildQuality(boxes, RTC_BUILD_QUALITY_HIGH);
        rtcCommitGeometry(boxes);
        rtcAttachGeometry(scene_, boxes);
        rtcReleaseGeometry(boxes);
        rtcCommitScene(scene_);
    }
    ~BoxScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    BoxScene(const BoxScene&) = delete;
    BoxScene& operator=(const BoxScene&) = delete;

    /// As EmbreeScene does; `triangle` is the number of the voxel.
    void closestHit(const std::vector<Ray>& rays, std::vector<Hit>& hits) const {
        parallelRanges(rays.size(), kGrain, [&](size_t begin, size_t end) {
            EmbreeQuery embree(Coherence::Incoherent);
            for (size_t i = begin; i < end; ++i) {
                const Ray& r = rays[i];
                RTCRayHit query;
                query.ray = {
                    r.origin.x, r.origin.y,  r.origin.z, r.tMin, r.direction.x, r.direction.y, r.direction.z, 0.0f,
                    r.tMax,     0xffffffffu, 0,          0};
                query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
                embree.intersect(scene_, query);
                const bool isHit = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
                hits[i] = {query.ray.tfar, isHit ? query.hit.primID : Hit::kMiss, 0, 0};
            }
        });
    }

 private:
    glm::vec3 corner(unsigned voxel) const { return grid_.origin + grid_.voxelSize * glm::vec3(voxels_[voxel]); }

    static void bounds(const RTCBoundsFunctionArguments* args) {
        const auto& self = *static_cast<const BoxScene*>(args->geometryUserPtr);
        const glm::vec3 low = self.corner(args->primID), high = low + self.grid_.voxelSize;
        args->bounds_o->lower_x = low.x, args->bounds_o->lower_y = low.y, args->bounds_o->lower_z = low.z;
        args->bounds_o->upper_x = high.x, args->bounds_o->upper_y = high.y, args->bounds_o->upper_z = high.z;
    }

    static void intersect(const RTCIntersectFunctionNArguments* args) {
        const auto& self = *static_cast<const BoxScene*>(args->geometryUserPtr);
        if (args->valid[0] == 0) return;
        RTCRayHit& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);  // Of rtcIntersect1: N is 1.
        const glm::vec3 inverse(1 / query.ray.dir_x, 1 / query.ray.dir_y, 1 / query.ray.dir_z);
        const glm::vec3 origin(query.ray.org_x, query.ray.org_y, query.ray.org_z);
        const glm::vec3 low = (self.corner(args->primID) - origin) * inverse;
        const glm::vec3 high = low + self.grid_.voxelSize * inverse;
        const glm::vec3 first = glm::min(low, high), last = glm::max(low, high);
        const float enter = std::max({first.x, first.y, first.z, query.ray.tnear});
        if (enter > std::min({last.x, last.y, last.z, query.ray.tfar})) return;
        query.ray.tfar = enter;
        query.hit.primID = args->primID;
        query.hit.geomID = args->geomID;
    }

    gpu::VoxelGrid grid_;
    const std::vector<glm::ivec3>& voxels_;
    RTCDevice device_;
    RTCScene scene_;
};

/// From one point into all directions, as light rays go.
std::vector<Ray> raysFrom(glm::vec3 origin) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<Ray> rays(kRays);
    for (Ray& ray : rays) {
        const float z = 2 * unit(random) - 1, phi = 6.2831853f * unit(random), r = std::sqrt(1 - z * z);
        ray = {origin, 0, {r * std::cos(phi), r * std::sin(phi), z}, kFar};
    }
    return rays;
}

template <typename F>
double secondsOf(const F& f) {
    const double start = cpuSeconds();
    f();
    return cpuSeconds() - start;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Builds and traces both, one after the other in each iteration: medians of ratios of CPU time, boxes over
/// triangles. `early`: by how many voxels' widths a ray ends too soon, in the mean; `wrong voxel`: the part
/// of hits whose place, rounded down to a voxel, is not the voxel that was hit.
void voxelBvh(benchmark::State& state, const char* file, glm::vec3 light) {
    const auto path = test::scenesFolder() / file;
    if (!std::filesystem::exists(path)) return state.SkipWithError("the scene was not found");
    test::device();  // Made before the chain, so that it goes after it.
    const auto scene = std::make_shared<SceneState>(evaluate(loadGltf(path), 0.0));
    scene->cameras.emplace_back();
    test::Chain chain(scene, fmt::format("[{{pass: voxelize, visibility_rays: 0, resolution: {}}}]", state.range(0)),
                      16, 16, 1);
    const test::Voxels read(chain);
    std::vector<glm::ivec3> voxels;
    read.forEach([&](glm::ivec3 v) {
        if (read.occupied(v)) voxels.push_back(v);
    });

    const std::vector<Ray> rays = raysFrom(light);
    std::vector<Hit> hits(kRays), boxHits(kRays);
    std::vector<double> buildRatios, traceRatios;
    for (auto _ : state) {
        std::optional<EmbreeScene> triangles;
        std::optional<BoxScene> boxes;
        const double buildTriangles = secondsOf([&] { triangles.emplace(*scene); });
        buildRatios.push_back(secondsOf([&] { boxes.emplace(read.grid, voxels); }) / buildTriangles);
        const double traceTriangles = secondsOf([&] { triangles->closestHit(rays, hits); });
        const double traceBoxes = secondsOf([&] { boxes->closestHit(rays, boxHits); });
        traceRatios.push_back(traceBoxes / traceTriangles);
        state.SetIterationTime(traceBoxes);
    }

    double early = 0;
    size_t both = 0, met = 0, wrong = 0;
    for (size_t i = 0; i < kRays; ++i) {
        if (boxHits[i].triangle == Hit::kMiss) continue;
        const glm::vec3 place = rays[i].origin + boxHits[i].t * rays[i].direction;
        const glm::ivec3 voxel(glm::floor((place - read.grid.origin) / read.grid.voxelSize));
        ++met;
        wrong += voxel != voxels[boxHits[i].triangle];
        if (hits[i].triangle == Hit::kMiss) continue;
        ++both;
        early += double((hits[i].t - boxHits[i].t) / read.grid.voxelSize);
    }
    state.counters["build_ratio"] = median(buildRatios);
    state.counters["trace_ratio"] = median(traceRatios);
    state.counters["voxels"] = double(voxels.size());
    state.counters["triangles"] = double(scene->geometry.triangles.size());
    state.counters["early_voxels"] = early / double(both);
    state.counters["wrong_voxel"] = double(wrong) / double(met);
}
void voxelBvhSibenik(benchmark::State& state) {
    voxelBvh(state, "sibenik.glb", {0, -5, 0});
}
void voxelBvhSponza(benchmark::State& state) {
    voxelBvh(state, "sponza.glb", {0, 6, 0});
}
BENCHMARK(voxelBvhSibenik)->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(7);
BENCHMARK(voxelBvhSponza)->Arg(64)->Arg(128)->Arg(256)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(7);

}  // namespace
}  // namespace voxray
