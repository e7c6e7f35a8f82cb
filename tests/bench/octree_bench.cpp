#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <map>

#include "passes/filter_voxels/octree_builder.h"
#include "tests/gpu/chain.h"

namespace voxray {
namespace {

std::filesystem::path scenesFolder() {
    const char* folder = std::getenv("VOXRAY_SCENES");
    return folder ? std::filesystem::path(folder)
                  : std::filesystem::path(VOXRAY_SOURCE_DIR "/../shared/scenes");
}

/// Sponza's surface voxels.
test::Chain& sponza(uint32_t resolution) {
    static std::map<uint32_t, std::unique_ptr<test::Chain>> chains;
    std::unique_ptr<test::Chain>& chain = chains[resolution];
    if (chain) return *chain;
    const auto scene = std::make_shared<SceneState>(evaluate(loadGltf(scenesFolder() / "sponza.glb"), 0.0));
    scene->cameras.emplace_back();
    chain = std::make_unique<test::Chain>(
        scene, fmt::format("[{{pass: voxelize, resolution: {}, exposure_rays: 0}}]", resolution), 16, 16, 1);
    return *chain;
}

/// Building the structure over Sponza, and filtering; memory as the octree holds it.
void octreeBuild(benchmark::State& state) {
    const SurfaceVoxels& voxels = *sponza(uint32_t(state.range(0))).graph().resource<SurfaceVoxels>("voxels");
    const ShaderCompiler compiler(VOXRAY_SOURCE_DIR, VOXRAY_TEST_CACHE);
    const OctreeBuilder builder(test::device(), compiler);
    CommandStream stream(test::device());
    OctreeSize size;
    for (auto _ : state) {
        RadianceVoxels radiance;
        radiance.grid = {voxels.grid.origin,       voxels.grid.voxelSize,
                         voxels.grid.resolution,   radianceLevels(voxels.grid.resolution),
                         uint32_t(state.range(1)), 1.0f};
        size = builder.build(stream, voxels, radiance).size;
        builder.filter(stream, size, radiance);
        stream.finish();
    }
    state.counters["voxels"] = voxels.voxelCount;
    state.counters["MB"] = double(size.bytes()) / 1e6;
    state.counters["bytes_per_voxel"] = double(size.bytes()) / voxels.voxelCount;
    state.counters["structure_bytes_per_voxel"] =
        double(size.nodeBytes() + size.tableBytes()) / voxels.voxelCount;
    state.counters["scratch_MB"] = double(OctreeBuilder::scratchBytes(size)) / 1e6;
}
BENCHMARK(octreeBuild)
    ->ArgNames({"resolution", "directions"})
    ->ArgsProduct({{64, 128, 256, 512}, {1, 6}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxray
