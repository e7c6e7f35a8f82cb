#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "passes/common/octree/octree_builder.h"
#include "passes/cones/filter_voxels/svo_values.h"
#include "scene/moving_spheres.h"
#include "tests/bench/sponza.h"
#include "tests/support/programs.h"

namespace voxray {
namespace {

/// Building the structure over Sponza, and filtering; memory as the octree holds it.
void octreeBuild(benchmark::State& state) {
    const SurfaceVoxels& voxels = *sponza(uint32_t(state.range(0))).graph().resource<SurfaceVoxels>("voxels");
    test::TestPrograms programs;
    const OctreeBuilder builder(programs);
    const SvoFilter filter(programs);
    programs.compile();
    CommandStream stream(test::device());
    OctreeSize size;
    uint64_t bytes = 0;
    for (auto _ : state) {
        RadianceVoxels radiance;
        radiance.grid = {voxels.grid.origin,       voxels.grid.voxelSize,
                         voxels.grid.resolution,   gridLevels(voxels.grid.resolution),
                         uint32_t(state.range(1)), 1.0f};
        allocateSvoValues(stream, builder.build(stream, voxels), radiance);
        size = radiance.octree.size;
        bytes = size.nodeBytes() + size.tableBytes() + radiance.storage[0].bytes();
        const Buffer changed(test::device(), "changed", SvoFilter::changedBytes(size));
        stream.fill(changed, ~0u);
        filter.run(stream, radiance, changed);
        stream.finish();
    }
    const glm::uvec3 grid = voxels.grid.resolution;
    state.counters["voxels"] = voxels.voxelCount;
    state.counters["grid_voxels"] = double(grid.x) * grid.y * grid.z;
    state.counters["MB"] = double(bytes) / 1e6;
    state.counters["bytes_per_voxel"] = double(bytes) / voxels.voxelCount;
    state.counters["structure_bytes_per_voxel"] = double(size.nodeBytes() + size.tableBytes()) / voxels.voxelCount;
}
BENCHMARK(octreeBuild)
    ->ArgNames({"resolution", "directions"})
    ->ArgsProduct({{64, 128, 256, 512}, {1, 6}})
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

/// Voxels and octree of Sponza made again, and following spheres of 0.5 m that move by 5 cm: CPU time of
/// both, and how they compare. The update has that of scene and ray tracer too. The octree's structure is
/// built again in either case; light is left out.
void octreeUpdate(benchmark::State& state) {
    auto scene = std::make_shared<Scene>(*loadGltf(test::scenesFolder() / "sponza.glb"));
    MovingSpheres spheres;
    spheres.count = uint32_t(state.range(1));
    spheres.center = {0, 2.5f, 0};
    spheres.spacing = 0.8f;
    addMovingSpheres(*scene, spheres);
    auto start = std::make_shared<SceneState>(evaluate(std::move(scene), 0.0, Playback::Looping));
    start->cameras.emplace_back();
    test::Chain chain(start, fmt::format("[{{pass: voxelize, resolution: {}}}]", state.range(0)), 16, 16, 1);
    const SurfaceVoxels& voxels = *chain.graph().resource<SurfaceVoxels>("voxels");
    test::TestPrograms programs;
    const OctreeBuilder builder(programs);
    const SvoFilter filter(programs);
    programs.compile();
    CommandStream stream(test::device());
    const auto octree = [&] {
        RadianceVoxels radiance;
        radiance.grid = {voxels.grid.origin,
                         voxels.grid.voxelSize,
                         voxels.grid.resolution,
                         gridLevels(voxels.grid.resolution),
                         1,
                         1.0f};
        allocateSvoValues(stream, builder.build(stream, voxels), radiance);
        const Buffer all(test::device(), "changed", SvoFilter::changedBytes(radiance.octree.size));
        stream.fill(all, ~0u);
        filter.run(stream, radiance, all);
        stream.finish();
    };
    double whole = 0, update = 0, structure = 0, seconds = 0;
    for (auto _ : state) {
        const double begin = cpuSeconds();
        chain.rebuild();
        const double center = cpuSeconds();
        octree();
        const double end = cpuSeconds();
        seconds += 0.05;
        chain.goTo(seconds);
        octree();
        whole += end - begin;
        structure += end - center;
        update += cpuSeconds() - end;
    }
    const double runs = double(state.iterations());
    state.counters["voxels"] = voxels.voxelCount;
    state.counters["whole_ms"] = 1000 * whole / runs;
    state.counters["update_ms"] = 1000 * update / runs;
    state.counters["octree_ms"] = 1000 * structure / runs;
    state.counters["update_over_whole"] = update / whole;
}
BENCHMARK(octreeUpdate)
    ->ArgNames({"resolution", "spheres"})
    ->ArgsProduct({{256}, {1, 125}})
    ->MeasureProcessCPUTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

constexpr std::array kThinConeLayouts{"dense", "svo", "clipmap, clipmap_resolution: 128", "svo_bricks"};

/// Cones of 5 m from the center of Sponza through each layout: as far as the clipmap's finest window reaches
/// at 256 voxels, so that all take the same samples; bricks with one value a voxel alone.
void thinCone(benchmark::State& state) {
    const RadianceVoxels& radiance =
        *sponza(uint32_t(state.range(0)), uint32_t(state.range(1)),
                fmt::format(", {{pass: inject_light_rays, rays_per_light: 65536, bounces: 2}}"
                            ", {{pass: filter_voxels, layout: {}}}",
                            kThinConeLayouts.at(size_t(state.range(2)))))
             .graph()
             .resource<RadianceVoxels>("radiance");
    test::TestPrograms programs;
    const Kernel kernel(programs, "thin_cone.comp", radiance.defines());
    programs.compile();
    constexpr uint32_t kCones = 20000;
    const Buffer met(test::device(), "met", kCones * sizeof(glm::vec4));
    const Bindings bindings{radiance,
                            {"met", met},
                            {"origin", glm::vec3(0, 3, 0)},
                            {"reach", 5.0f},
                            {"width", 0.01f * float(state.range(3))},
                            {"count", kCones}};
    CommandStream stream(test::device());
    const auto run = [&] {
        stream.dispatch(kernel, kCones, bindings);
        stream.finish();
    };
    run();  // The driver may compile in the first one.
    for (auto _ : state) run();
    double coverage = 0;
    for (const glm::vec4& sum : stream.readAs<glm::vec4>(met, kCones)) coverage += sum.a / kCones;
    state.counters["coverage"] = coverage;
}
BENCHMARK(thinCone)
    ->ArgNames({"resolution", "directions", "layout", "width_percent"})
    ->ArgsProduct({{256}, {1, 6}, {0, 1, 2}, {0, 20}})
    ->ArgsProduct({{64, 128, 256, 512}, {1}, {2, 3}, {0}})
    ->MeasureProcessCPUTime()
    ->Iterations(8)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxray
