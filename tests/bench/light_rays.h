#pragma once

#include <glm/gtc/packing.hpp>
#include <memory>
#include <random>

#include "config/config.h"
#include "experiment/scene_files.h"
#include "experiment/scene_setup.h"
#include "passes/common/view/gbuffer.h"
#include "passes/vpls/vpls.h"
#include "scene/region_split.h"
#include "tests/bench/sponza.h"
#include "tests/gpu/between_surfaces.h"
#include "tests/support/places.h"

namespace voxray {

/// Shadow rays between what a camera sees and virtual lights, and the light that each carries if it arrives.
struct LightRays {
    std::vector<test::SurfacePair> pairs;
    std::vector<double> light;
};

/// Random ones of those that gather_vpls traces: both sides face each other.
inline LightRays lightRays(test::Chain& chain, size_t count) {
    const Vpls& vpls = *chain.graph().resource<Vpls>("vpls");
    const GBuffer& gbuffer = *chain.graph().resource<GBuffer>("gbuffer");
    const auto points = chain.read<gpu::Vpl>(vpls.points);
    const auto list = chain.read<uint32_t>(vpls.activeIndices);
    const auto positions = chain.readImage<glm::vec4>(gbuffer.position);
    const auto normals = chain.readImage<glm::u16vec4>(gbuffer.geometricNormal);
    const double bound = surfaceArea(chain.state().geometry) / (3.14159265358979 * vpls.paths);
    std::mt19937 random(1);
    LightRays rays;
    while (rays.pairs.size() < count) {
        const size_t texel = random() % positions.size();
        if (positions[texel].w == 0) continue;
        const gpu::Vpl& vpl = points[list[random() % vpls.activeCount]];
        const glm::vec3 at(positions[texel]), normal = glm::normalize(glm::vec3(glm::unpackHalf(normals[texel])));
        const glm::vec3 way = vpl.position - at;
        const double squared = glm::dot(way, way);
        const double cosines = double(glm::dot(normal, way)) * -double(glm::dot(vpl.normal, way));
        if (glm::dot(normal, way) <= 0 || glm::dot(vpl.normal, way) >= 0) continue;
        rays.pairs.push_back({at, normal, vpl.position, vpl.normal});
        rays.light.push_back(double(vpl.flux.x + vpl.flux.y + vpl.flux.z) * cosines / squared /
                             std::max(squared, bound));
    }
    return rays;
}

/// The scene of a config in configs/generality/ with its voxels and virtual lights; `more`: passes after
/// voxelization.
inline std::unique_ptr<test::Chain> litScene(const std::string& scene, uint32_t resolution,
                                             const std::string& more = "") {
    test::device();
    const std::filesystem::path file = test::sourceRoot() / "configs/generality" / (scene + ".yaml");
    SceneLoader loader(sceneFolders({}, test::sourceRoot(), file));
    const auto prepared = std::make_shared<SceneState>(loader.prepare(loadExperiment(file).setup.scene).state);
    return std::make_unique<test::Chain>(
        prepared,
        fmt::format("[{{pass: gbuffer}}, {{pass: voxelize, resolution: {}}}{}, {{pass: sample_vpls, vpls_per_bounce: "
                    "2048}}, {{pass: gather_vpls, visibility: none}}]",
                    resolution, more),
        96, 54, 1);
}

}  // namespace voxray
