// What the time of gathering by cones depends on.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>

#include "tests/gpu/chain.h"
#include "tests/support/places.h"

namespace voxray {
namespace {

/// Every triangle replaced by four, in the same place.
void splitTriangles(Geometry& geometry) {
    const auto center = [&](uint32_t a, uint32_t b) {
        const VertexAttributes &first = geometry.attributes[a], &second = geometry.attributes[b];
        VertexAttributes mean = first;
        const glm::vec3 normal = first.normal + second.normal;
        if (glm::length(normal) > 1e-6f) mean.normal = glm::normalize(normal);
        mean.texCoords = 0.5f * (first.texCoords + second.texCoords);
        mean.color = 0.5f * (first.color + second.color);
        geometry.attributes.push_back(mean);
        geometry.positions.push_back(0.5f * (geometry.positions[a] + geometry.positions[b]));
        return uint32_t(geometry.positions.size() - 1);
    };
    const std::vector<glm::uvec3> whole = std::move(geometry.triangles);
    const std::vector<uint32_t> materials = std::move(geometry.triangleMaterials);
    geometry.triangles.clear();
    geometry.triangleMaterials.clear();
    for (size_t t = 0; t < whole.size(); ++t) {
        const glm::uvec3 v = whole[t];
        const uint32_t ab = center(v.x, v.y), bc = center(v.y, v.z), ca = center(v.z, v.x);
        for (const glm::uvec3 part :
             {glm::uvec3(v.x, ab, ca), glm::uvec3(ab, v.y, bc), glm::uvec3(ca, bc, v.z), glm::uvec3(ab, bc, ca)}) {
            geometry.triangles.push_back(part);
            geometry.triangleMaterials.push_back(materials[t]);
        }
    }
    geometry.instances = {{0, uint32_t(geometry.triangles.size()), 0, uint32_t(geometry.positions.size())}};
}

/// gather_cones in Sponza at 128³, the pass alone, with as many triangles as it has (1) or four times as many
/// (4).
void coneGather(benchmark::State& state) {
    const auto scene = std::make_shared<SceneState>(evaluate(loadGltf(test::scenesFolder() / "sponza.glb"), 0.0));
    if (state.range(0) == 4) splitTriangles(scene->geometry);
    Camera camera;
    camera.position = {-9, 1.2f, -0.3f};
    camera.forward = glm::normalize(glm::vec3(0, 3, 0) - camera.position);
    camera.up = glm::normalize(glm::cross(glm::cross(camera.forward, glm::vec3(0, 1, 0)), camera.forward));
    scene->cameras = {camera};
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = glm::normalize(glm::vec3(-0.12f, -1, -0.08f));
    sun.intensity = glm::vec3(10);
    scene->lights = {sun};
    test::Chain chain(scene,
                      test::graphYaml({"gbuffer", "voxelize, resolution: 128", "inject_light_rays, bounces: 1",
                                       "filter_voxels", "gather_cones, visibility: voxels, cones: 6"}),
                      96, 54, 1);
    for (auto _ : state) {
        chain.runFrameFrom(camera.position);
        state.SetIterationTime(chain.frameSamples.back().milliseconds * 1e-3);
    }
    state.counters["triangles"] = double(scene->geometry.triangles.size());
}
BENCHMARK(coneGather)->ArgName("split")->Arg(1)->Arg(4)->UseManualTime()->MinTime(4)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voxray
