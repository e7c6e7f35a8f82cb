#include <benchmark/benchmark.h>

#include <algorithm>
#include <numeric>

#include "passes/common/voxel_march/voxel_tracer.h"
#include "passes/common/voxels/voxels.h"
#include "tests/bench/light_rays.h"

namespace voxray {
namespace {

/// How far voxels agree with triangles about who sees whom, in the scene of a config in configs/generality/:
/// of all rays the parts in percent that are seen or hidden wrongly, and the light that arrives, is lost and
/// is gained, over the exact light.
void voxelVisibility(benchmark::State& state, const std::string& scene) {
    constexpr size_t kRays = 200000;
    const std::unique_ptr<test::Chain> chain = litScene(scene, uint32_t(state.range(0)));
    const LightRays rays = lightRays(*chain, kRays);
    const std::vector<uint32_t> exact = test::hiddenByTriangles(chain->state(), rays.pairs);
    const SurfaceVoxels& voxels = *chain->graph().resource<SurfaceVoxels>("voxels");
    std::vector<uint32_t> hidden;
    for (auto _ : state) hidden = test::hiddenByVoxels(voxels, rays.pairs);

    double all = 0, lost = 0, gained = 0;
    size_t wronglyHidden = 0, wronglySeen = 0;
    for (size_t i = 0; i < kRays; ++i) {
        if (!exact[i]) all += rays.light[i];
        if (hidden[i] && !exact[i]) ++wronglyHidden, lost += rays.light[i];
        if (!hidden[i] && exact[i]) ++wronglySeen, gained += rays.light[i];
    }
    state.counters["hidden_wrongly_percent"] = 100 * double(wronglyHidden) / kRays;
    state.counters["seen_wrongly_percent"] = 100 * double(wronglySeen) / kRays;
    state.counters["light"] = 1 + (gained - lost) / all;
    state.counters["light_lost"] = lost / all;
    state.counters["light_gained"] = gained / all;
}

#define VOXEL_VISIBILITY(scene)                       \
    BENCHMARK_CAPTURE(voxelVisibility, scene, #scene) \
        ->ArgName("resolution")                       \
        ->Arg(128)                                    \
        ->Arg(256)                                    \
        ->Arg(512)                                    \
        ->MeasureProcessCPUTime()                     \
        ->Iterations(1)                               \
        ->Unit(benchmark::kMillisecond)
VOXEL_VISIBILITY(sponza);
VOXEL_VISIBILITY(sibenik);
VOXEL_VISIBILITY(conference);
VOXEL_VISIBILITY(living_room);
VOXEL_VISIBILITY(kitchen);
VOXEL_VISIBILITY(cornell);

/// Shadow rays to virtual lights of Sponza at 256³ in three orders, each by the paper's walk and by ours, in
/// turns in one run, by CPU time. 0: as gather_vpls sends them, of all texels of a subset to one light, then
/// to the next. 1: the same with lights sorted by the octant that they lie in, from the grid's center. 2: of
/// a texel to all lights, by octant: packets by solid angle (Sun and Agu 2015, section 3.1). 3: at random.
void vplRayOrder(benchmark::State& state) {
    constexpr size_t kTexels = 1296, kLights = 256;  // Of a subset of 4×4 at 192 × 108.
    const std::unique_ptr<test::Chain> chain = litScene("sponza", 256);
    const SurfaceVoxels& voxels = *chain->graph().resource<SurfaceVoxels>("voxels");
    const Vpls& vpls = *chain->graph().resource<Vpls>("vpls");
    const GBuffer& gbuffer = *chain->graph().resource<GBuffer>("gbuffer");
    const auto points = chain->read<gpu::Vpl>(vpls.points);
    auto list = chain->read<uint32_t>(vpls.activeIndices);
    const auto positions = chain->readImage<glm::vec4>(gbuffer.position);
    const auto normals = chain->readImage<glm::u16vec4>(gbuffer.geometricNormal);
    list.resize(kLights);
    const glm::vec3 center = voxels.grid.origin + 0.5f * voxels.grid.voxelSize * glm::vec3(voxels.grid.resolution);
    const auto octant = [&](uint32_t light) {
        const glm::vec3 way = points[light].position - center;
        return (way.x > 0 ? 1 : 0) + (way.y > 0 ? 2 : 0) + (way.z > 0 ? 4 : 0);
    };
    if (state.range(0) == 1 || state.range(0) == 2)
        std::stable_sort(list.begin(), list.end(), [&](uint32_t a, uint32_t b) { return octant(a) < octant(b); });
    std::vector<test::SurfacePair> pairs;
    for (size_t i = 0; i < kTexels * kLights; ++i) {
        const bool byTexel = state.range(0) == 2;
        const size_t texel = (byTexel ? i / kLights : i % kTexels) * positions.size() / kTexels;
        const gpu::Vpl& vpl = points[list[byTexel ? i % kLights : i / kTexels]];
        const glm::vec3 at(positions[texel]), normal = glm::normalize(glm::vec3(glm::unpackHalf(normals[texel])));
        if (positions[texel].w == 0 || glm::dot(normal, vpl.position - at) <= 0 ||
            glm::dot(vpl.normal, at - vpl.position) <= 0)
            pairs.push_back({at, normal, at, normal});
        else
            pairs.push_back({at, normal, vpl.position, vpl.normal});
    }
    if (state.range(0) == 3) std::shuffle(pairs.begin(), pairs.end(), std::mt19937(1));
    std::vector<Ray> rays;
    size_t active = 0;
    for (const test::BetweenVoxels& way : test::betweenVoxels(voxels, pairs)) {
        const float length = glm::distance(way.from, way.to);
        const bool isActive = length > 0;
        active += isActive;
        rays.push_back(isActive ? Ray{way.from, 0, (way.to - way.from) / length, length}
                                : Ray{way.from, 0, glm::vec3(0, 0, 1), -1});
    }

    CommandStream stream(test::device());
    const Buffer in(test::device(), "rays", rays.size() * sizeof(Ray));
    const Buffer out(test::device(), "answers", rays.size() * sizeof(uint32_t));
    stream.upload(in, rays);
    test::TestPrograms programs;
    VoxelTracer restart(programs, VoxelTraversal::SvoRestart), ours(programs, VoxelTraversal::Svo);
    double seconds[2] = {};
    const auto trace = [&](VoxelTracer& tracer) {
        const double begin = cpuSeconds();
        tracer.occluded(stream, in, out, uint32_t(rays.size()));
        stream.finish();
        return cpuSeconds() - begin;
    };
    for (VoxelTracer* tracer : {&restart, &ours}) {
        test::prepare(programs, *tracer, voxels);
        tracer->begin(stream, voxels);
        trace(*tracer);
    }
    for (auto _ : state) {
        seconds[0] += trace(restart);
        seconds[1] += trace(ours);
    }
    const double count = double(state.iterations()) * double(active) / 1e6;
    state.counters["svo_restart_Mrays_s"] = count / seconds[0];
    state.counters["svo_Mrays_s"] = count / seconds[1];
    state.counters["svo_over_svo_restart"] = seconds[0] / seconds[1];
}
BENCHMARK(vplRayOrder)->ArgName("order")->DenseRange(0, 3)->Iterations(5)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxray
