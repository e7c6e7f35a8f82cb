#include <benchmark/benchmark.h>

#include <algorithm>

#include "config/config.h"
#include "experiment/scene_files.h"
#include "experiment/scene_setup.h"
#include "passes/hybrid_leaves/hybrid_tracer.h"
#include "scene/camera_rays.h"
#include "tests/bench/sponza.h"
#include "tests/gpu/prepared.h"

namespace voxray {
namespace {

constexpr uint32_t kSide = 512;  // Pixels.

std::vector<Hit> closestHits(CommandStream& stream, RayTracer& tracer, const std::vector<Ray>& rays) {
    const Buffer in(test::device(), "rays", rays.size() * sizeof(Ray));
    const Buffer out(test::device(), "hits", rays.size() * sizeof(Hit));
    stream.upload(in, rays);
    tracer.closestHit(stream, in, out, uint32_t(rays.size()));
    return stream.readAs<Hit>(out, rays.size());
}

/// What a mirror on every surface would reflect: rays from the scene's camera, by pixel, reflected where they
/// end.
std::vector<Ray> mirrorRays(CommandStream& stream, RayTracer& tracer, const SceneState& state) {
    const Geometry& geometry = state.geometry;
    const CameraRays camera = cameraRays(state.cameras.at(0), kSide, kSide);
    std::vector<Ray> rays(kSide * kSide);
    for (uint32_t i = 0; i < rays.size(); ++i) {
        const float x = (float(i % kSide) + 0.5f) / kSide, y = (float(i / kSide) + 0.5f) / kSide;
        rays[i] = {camera.origin, 0, glm::normalize(camera.direction(x, y)), 1000};
    }
    const std::vector<Hit> hits = closestHits(stream, tracer, rays);
    std::vector<Ray> reflected;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].triangle == Hit::kMiss) continue;
        const glm::uvec3 t = geometry.triangles[hits[i].triangle];
        const glm::vec3 a = geometry.positions[t.x];
        glm::vec3 normal = glm::normalize(glm::cross(geometry.positions[t.y] - a, geometry.positions[t.z] - a));
        if (glm::dot(normal, rays[i].direction) > 0) normal = -normal;
        const glm::vec3 at = rays[i].origin + hits[i].t * rays[i].direction;
        reflected.push_back({at + 1e-4f * normal, 0, glm::reflect(rays[i].direction, normal), 1000});
    }
    return reflected;
}

/// The mirror rays of a scene, with what Embree finds along them.
struct MirrorRays {
    explicit MirrorRays(const SceneState& state)
        : scene(makeGpuScene(test::device(), stream, state)),
          embree(makeRayTracer(TracerKind::Embree, test::device(), compiler, state)),
          rays(mirrorRays(stream, *embree, state)),
          expected(closestHits(stream, *embree, rays)) {}

    ShaderCompiler compiler{test::sourceRoot(), test::shaderCache()};
    CommandStream stream{test::device()};
    GpuScene scene;
    std::unique_ptr<RayTracer> embree;
    std::vector<Ray> rays;
    std::vector<Hit> expected;
};

/// Rays by the octant of their direction, then along a Morton curve by their origin.
std::vector<Ray> sorted(const std::vector<Ray>& rays, const Geometry& geometry) {
    const glm::vec3 scale = 1023.0f / (geometry.boundsMax - geometry.boundsMin);
    std::vector<std::pair<uint64_t, size_t>> keys;
    for (size_t i = 0; i < rays.size(); ++i) {
        const glm::uvec3 cell(glm::clamp((rays[i].origin - geometry.boundsMin) * scale, glm::vec3(0), glm::vec3(1023)));
        uint64_t key = 0;
        for (int axis = 0; axis < 3; ++axis) {
            key |= uint64_t(rays[i].direction[axis] < 0) << (30 + axis);
            for (int bit = 0; bit < 10; ++bit) key |= uint64_t(cell[axis] >> bit & 1u) << (3 * bit + axis);
        }
        keys.emplace_back(key, i);
    }
    std::ranges::sort(keys);
    std::vector<Ray> result;
    for (const auto& [key, i] : keys) result.push_back(rays[i]);
    return result;
}

/// The scene of a config in configs/papers/seok2021/ at 256³; `more`: passes after voxelization. One is kept
/// at a time.
test::Chain& mirrorScene(const std::string& config, const std::string& more) {
    test::device();  // Made before the chains, so that it goes after them.
    static std::string current;
    static std::shared_ptr<const SceneState> state;
    static std::map<std::string, std::unique_ptr<test::Chain>> chains;
    if (current != config) {
        chains.clear();
        const std::filesystem::path file = test::sourceRoot() / "configs/papers/seok2021" / (config + ".yaml");
        SceneLoader loader(sceneFolders({}, test::sourceRoot(), file));
        state = std::make_shared<SceneState>(loader.prepare(loadExperiment(file).setup.scene).state);
        current = config;
    }
    std::unique_ptr<test::Chain>& chain = chains[more];
    if (!chain) {
        std::erase_if(chains, [](const auto& other) { return !other.first.empty(); });
        chains[more] = std::make_unique<test::Chain>(
            state, "[{pass: voxelize, resolution: 256, directions: 1, visibility_rays: 0}" + more + "]", 16, 16, 1);
    }
    return *chains[more];
}

/// Reflected rays through a scene's leaves by both walks, by `hierarchical` also sorted on the host (which is
/// not counted), and by the ray tracers, one after another in each iteration: rays a second of CPU time;
/// steps, visits and tests of triangles a ray; the rays that meet a cell; those that meet another triangle
/// than Embree's, of those that meet a triangle; memory by kind, and the build's time.
void hybridLeaves(benchmark::State& state, const std::string& config) {
    test::Chain& without = mirrorScene(config, "");
    test::Chain& chain = mirrorScene(config, fmt::format(", {{pass: build_hybrid_leaves, primitives: {}, grid: {}}}",
                                                         state.range(0), state.range(1)));
    const SurfaceVoxels& voxels = *chain.graph().resource<SurfaceVoxels>("voxels");
    const HybridLeaves& leaves = *chain.graph().resource<HybridLeaves>("hybrid_leaves");
    MirrorRays mirror(chain.state());
    auto& [compiler, stream, scene, embree, rays, expected] = mirror;
    const double count = double(rays.size());

    // Once each outside of the measurement
    test::TestPrograms programs;
    std::vector<std::pair<std::string, std::unique_ptr<RayTracer>>> tracers;
    for (const auto& [walk, name] : EnumNames<HybridTraversal>::names) {
        auto tracer = std::make_unique<HybridTracer>(programs, walk);
        test::prepare(programs, *tracer, voxels);
        tracer->begin(stream, scene, voxels, leaves);
        const std::vector<Hit> hits = closestHits(stream, *tracer, rays);
        const std::vector<uint64_t> walked = stream.readAs<uint64_t>(tracer->counts(), 2);
        state.counters[std::string(name) + "_steps"] = double(walked[0]) / count;
        state.counters[std::string(name) + "_visits"] = double(walked[1]) / count;
        state.counters["tests"] = double(stream.readAs<uint64_t>(tracer->testCounts(), 1)[0]) / count;
        size_t cells = 0, triangles = 0, different = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            const Hit &a = expected[i], &b = hits[i];
            cells += b.triangle != Hit::kMiss && b.triangle >= HIT_IS_CELL;
            if (b.triangle >= HIT_IS_CELL && b.triangle != Hit::kMiss) continue;
            triangles += b.triangle != Hit::kMiss;
            different += a.triangle != b.triangle && !(std::abs(a.t - b.t) <= 1e-5f * (1 + a.t));
        }
        state.counters["cells_percent"] = 100 * double(cells) / count;
        state.counters["differ_ppm"] = 1e6 * double(different) / double(std::max<size_t>(triangles, 1));
        tracers.emplace_back(name, std::move(tracer));
    }
    tracers.emplace_back("embree", makeRayTracer(TracerKind::Embree, test::device(), compiler, chain.state()));
    if (test::device().info().rayQuery)
        tracers.emplace_back("ray_query", makeRayTracer(TracerKind::RayQuery, test::device(), compiler, chain.state()));

    const Buffer in(test::device(), "rays", rays.size() * sizeof(Ray));
    const Buffer inSorted(test::device(), "sorted rays", in.bytes());
    const Buffer out(test::device(), "hits", rays.size() * sizeof(Hit));
    stream.upload(in, rays);
    stream.upload(inSorted, sorted(rays, chain.state().geometry));
    struct Measured {
        std::string name;
        RayTracer* tracer;
        const Buffer* rays;
        double seconds = 0;
    };
    std::vector<Measured> all;
    for (const auto& [name, tracer] : tracers) all.push_back({name, tracer.get(), &in});
    all.push_back({"hierarchical_sorted", tracers[0].second.get(), &inSorted});
    for (Measured& m : all) m.tracer->closestHit(stream, *m.rays, out, uint32_t(rays.size()));
    stream.finish();
    for (auto _ : state)
        for (Measured& m : all) {
            const double begin = cpuSeconds();
            m.tracer->closestHit(stream, *m.rays, out, uint32_t(rays.size()));
            stream.finish();
            m.seconds += cpuSeconds() - begin;
        }
    for (const Measured& m : all)
        state.counters[m.name + "_Mrays_s"] = double(state.iterations()) * count / 1e6 / m.seconds;
    state.counters["hierarchical_over_voxel_by_voxel"] = all[1].seconds / all[0].seconds;
    const auto build = [](test::Chain& built) {
        const double begin = cpuSeconds();
        built.rebuild();
        return 1e3 * (cpuSeconds() - begin);
    };
    const double voxelize = std::min(build(without), build(without));
    state.counters["voxelize_ms"] = voxelize;
    state.counters["build_ms"] = std::min(build(chain), build(chain)) - voxelize;
    state.counters["leaves_KiB"] = double(leaves.structureBytes()) / 1024;
    state.counters["lists_KiB"] = double(leaves.listBytes()) / 1024;
    state.counters["grids_KiB"] = double(leaves.gridBytes()) / 1024;
    state.counters["grids"] = leaves.gridCount;
    state.counters["leaves"] = leaves.shape.leaves;
}

/// Reflected rays through lists alone of one kind: the part of those that meet a triangle that meet another one by
/// lists, farther away, or none; pairs of a triangle and a leaf; memory of the lists and of the ray tracers' BVHs.
void hybridListHits(benchmark::State& state, const std::string& config, const std::string& lists) {
    test::Chain& chain =
        mirrorScene(config, ", {pass: build_hybrid_leaves, primitives: 1048576, lists: " + lists + "}");
    const SurfaceVoxels& voxels = *chain.graph().resource<SurfaceVoxels>("voxels");
    const HybridLeaves& leaves = *chain.graph().resource<HybridLeaves>("hybrid_leaves");
    MirrorRays mirror(chain.state());
    auto& [compiler, stream, scene, embree, rays, expected] = mirror;
    test::TestPrograms programs;
    HybridTracer tracer(programs, HybridTraversal::Hierarchical);
    test::prepare(programs, tracer, voxels);
    tracer.begin(stream, scene, voxels, leaves);
    size_t hits = 0, missed = 0;
    for (auto _ : state) {
        const std::vector<Hit> found = closestHits(stream, tracer, rays);
        for (size_t i = 0; i < rays.size(); ++i) {
            const Hit &a = expected[i], &b = found[i];
            if (a.triangle == Hit::kMiss) continue;
            ++hits;
            missed += b.triangle == Hit::kMiss || b.t > a.t + 1e-5f * (1 + a.t);
        }
    }
    state.counters["hits"] = double(hits);
    state.counters["missed_percent"] = 100 * double(missed) / double(hits);
    state.counters["listed_pairs"] = leaves.primitiveCount;
    state.counters["leaves"] = leaves.shape.leaves;
    state.counters["lists_KiB"] = double(leaves.listBytes()) / 1024;
    state.counters["embree_KiB"] = double(embree->memoryBytes()) / 1024;
    if (!test::device().info().rayQuery) return;
    const auto rayQuery = makeRayTracer(TracerKind::RayQuery, test::device(), compiler, chain.state());
    state.counters["ray_query_KiB"] = double(rayQuery->memoryBytes()) / 1024;
}

/// Capacities p and grids of m³.
void manyLeaves(benchmark::internal::Benchmark* b) {
    b->ArgNames({"primitives", "grid"});
    for (const auto& [p, m] :
         std::vector<std::pair<int, int>>{{8, 8}, {8, 16}, {32, 8}, {32, 16}, {64, 16}, {128, 16}, {1 << 20, 16}})
        b->Args({p, m});
}
void fewLeaves(benchmark::internal::Benchmark* b) {
    b->ArgNames({"primitives", "grid"})->Args({8, 8})->Args({64, 16})->Args({1 << 20, 16});
}
BENCHMARK_CAPTURE(hybridLeaves, sponza, "table1")
    ->Apply(manyLeaves)
    ->MeasureProcessCPUTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hybridLeaves, bunnies, "table1_bunnies")
    ->Apply(fewLeaves)
    ->MeasureProcessCPUTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hybridLeaves, kitchen, "table1_kitchen")
    ->Apply(fewLeaves)
    ->MeasureProcessCPUTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hybridListHits, sponza_exact, "table1", "exact")->Iterations(1);
BENCHMARK_CAPTURE(hybridListHits, sponza_fragments, "table1", "fragments")->Iterations(1);
BENCHMARK_CAPTURE(hybridListHits, sponza_conservative, "table1", "conservative")->Iterations(1);
BENCHMARK_CAPTURE(hybridListHits, bunnies_exact, "table1_bunnies", "exact")->Iterations(1);
BENCHMARK_CAPTURE(hybridListHits, kitchen_exact, "table1_kitchen", "exact")->Iterations(1);

}  // namespace
}  // namespace voxray
