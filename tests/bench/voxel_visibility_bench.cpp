#include <benchmark/benchmark.h>

#include <glm/gtc/packing.hpp>
#include <random>

#include "config/config.h"
#include "experiment/scene_setup.h"
#include "passes/common/lights/light_sources.h"
#include "passes/common/view/gbuffer.h"
#include "passes/common/voxels/voxels.h"
#include "passes/common/vpls/vpls.h"
#include "tests/bench/sponza.h"
#include "tests/gpu/between_surfaces.h"
#include "tests/support/places.h"

namespace voxray {
namespace {

/// Shadow rays between what a camera sees and virtual lights, and the light that each carries if it arrives.
struct LightRays {
    std::vector<test::SurfacePair> pairs;
    std::vector<double> light;
};

/// Random ones of those that gather_vpls traces: both sides face each other.
LightRays lightRays(test::Chain& chain, size_t count) {
    const Vpls& vpls = *chain.graph().resource<Vpls>("vpls");
    const GBuffer& gbuffer = *chain.graph().resource<GBuffer>("gbuffer");
    const auto points = chain.read<gpu::Vpl>(vpls.points);
    const auto list = chain.read<uint32_t>(vpls.list);
    const auto positions = chain.readImage<glm::vec4>(gbuffer.position);
    const auto normals = chain.readImage<glm::u16vec4>(gbuffer.geometricNormal);
    const double bound = surfaceArea(chain.state().geometry) / (3.14159265358979 * vpls.paths);
    std::mt19937 random(1);
    LightRays rays;
    while (rays.pairs.size() < count) {
        const size_t texel = random() % positions.size();
        if (positions[texel].w == 0) continue;
        const gpu::Vpl& vpl = points[list[random() % vpls.count]];
        const glm::vec3 at(positions[texel]),
            normal = glm::normalize(glm::vec3(glm::unpackHalf(normals[texel])));
        const glm::vec3 way = vpl.position - at;
        const double squared = glm::dot(way, way);
        const double cosines = double(glm::dot(normal, way)) * -double(glm::dot(vpl.faceNormal, way));
        if (glm::dot(normal, way) <= 0 || glm::dot(vpl.faceNormal, way) >= 0) continue;
        rays.pairs.push_back({at, normal, vpl.position, vpl.faceNormal});
        rays.light.push_back(double(vpl.flux.x + vpl.flux.y + vpl.flux.z) * cosines / squared /
                             std::max(squared, bound));
    }
    return rays;
}

/// How far voxels agree with triangles about who sees whom, in the scene of a config in configs/generality/:
/// of all rays the parts in percent that are seen or hidden wrongly, and the light that arrives, is lost and
/// is gained, over the exact light.
void voxelVisibility(benchmark::State& state, const std::string& scene) {
    constexpr size_t kRays = 200000;
    test::device();
    const std::filesystem::path file = test::sourceRoot() / "configs/generality" / (scene + ".yaml");
    SceneLoader loader(sceneFolders({}, test::sourceRoot(), file));
    const auto prepared =
        std::make_shared<SceneState>(loader.prepare(loadExperiment(file).setup.scene).state);
    test::Chain chain(
        prepared,
        fmt::format("[{{pass: gbuffer}}, {{pass: voxelize, resolution: {}}}, {{pass: sample_vpls, "
                    "vpls_per_bounce: 2048}}, {{pass: gather_vpls, visibility: none}}]",
                    state.range(0)),
        96, 54, 1);
    const LightRays rays = lightRays(chain, kRays);
    const std::vector<uint32_t> exact = test::hiddenByTriangles(chain.state(), rays.pairs);
    const SurfaceVoxels& voxels = *chain.graph().resource<SurfaceVoxels>("voxels");
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

}  // namespace
}  // namespace voxray
