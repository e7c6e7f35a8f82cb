// Memory of the octree of Arnebäck 2017 by count of its nodes and bricks, next to what the thesis measured.
#include <benchmark/benchmark.h>

#include <array>

#include "scene/load.h"
#include "tests/support/brick_octree_count.h"
#include "tests/support/places.h"

namespace voxray {
namespace {

constexpr std::array kMeasuredMiB{std::pair{64, 11.3}, std::pair{128, 58.4}, std::pair{256, 287.0},
                                  std::pair{512, 1320.0}};  ///< The thesis's figure 43.

/// The thesis's grid: a cube as wide as the scene's longest side, with the scene in its center.
gpu::VoxelGrid cubeRound(const Geometry& geometry, uint32_t resolution) {
    const glm::vec3 size = geometry.boundsMax - geometry.boundsMin;
    gpu::VoxelGrid grid{};
    const float side = std::max({size.x, size.y, size.z});
    grid.voxelSize = side / float(resolution);
    grid.origin = 0.5f * (geometry.boundsMin + geometry.boundsMax) - 0.5f * side;
    grid.resolution = glm::uvec3(resolution);
    return grid;
}

/// `samples`: of a pixel, by which triangles are voxelized; 0 for all voxels that they pass through.
/// `neighbors`: whether the 26 nodes round each are made to exist.
void publishedOctree(benchmark::State& state) {
    const auto path = test::scenesFolder() / "sponza.glb";
    if (!std::filesystem::exists(path)) return state.SkipWithError("the scene was not found");
    static const SceneState scene = evaluate(loadGltf(path), 0.0);
    const gpu::VoxelGrid grid = cubeRound(scene.geometry, uint32_t(state.range(0)));
    BrickOctreeCount count;
    for (auto _ : state)
        count = countBrickOctree(state.range(1) == 0 ? metVoxels(scene.geometry, grid)
                                                     : rasterizedVoxels(scene.geometry, grid, uint32_t(state.range(1))),
                                 state.range(2) == 1);
    for (size_t level = 0; level < count.levels.size(); ++level) {
        const BrickOctreeCount::Level& l = count.levels[level];
        const auto counter = [&](const char* name, uint64_t value) {
            state.counters[fmt::format("level_{}_{}", level, name)] = double(value);
        };
        counter("opaque", l.opaque);
        counter("bricks", l.bricks);
        counter("nodes", l.nodes);
    }
    const double mib = double(count.bytes()) / (1 << 20);
    state.counters["nodes"] = double(count.nodes());
    state.counters["bricks"] = double(count.bricks());
    state.counters["MiB"] = mib;
    for (const auto& [resolution, measured] : kMeasuredMiB)
        if (resolution == state.range(0)) state.counters["over_thesis"] = mib / measured;
}
BENCHMARK(publishedOctree)
    ->ArgNames({"resolution", "samples", "neighbors"})
    ->ArgsProduct({{64, 128, 256, 512}, {1, 8, 0}, {1}})
    ->ArgsProduct({{64, 128, 256, 512}, {8}, {0}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxray
