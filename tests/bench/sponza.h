#pragma once

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "tests/gpu/chain.h"
#include "tests/support/places.h"

namespace voxray {

/// Sponza's surface voxels, under a sun; `more`: passes after voxelization.
inline test::Chain& sponza(uint32_t resolution, uint32_t directions = 6, const std::string& more = "") {
    test::device();  // Made before the chains, so that it goes after them.
    static std::map<std::tuple<uint32_t, uint32_t, std::string>, std::unique_ptr<test::Chain>> chains;
    std::unique_ptr<test::Chain>& chain = chains[{resolution, directions, more}];
    if (chain) return *chain;
    const auto scene = std::make_shared<SceneState>(evaluate(loadGltf(test::scenesFolder() / "sponza.glb"), 0.0));
    scene->cameras.emplace_back();
    Light sun;
    sun.type = LightType::Directional;
    sun.direction = glm::normalize(glm::vec3(-0.12f, -1, -0.08f));
    sun.intensity = glm::vec3(10);
    scene->lights = {sun};
    chain = std::make_unique<test::Chain>(
        scene,
        fmt::format("[{{pass: voxelize, resolution: {}, directions: {}, visibility_rays: 0}}{}]", resolution,
                    directions, more),
        16, 16, 1);
    return *chain;
}

/// CPU seconds of the process so far, on all its threads.
inline double cpuSeconds() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace voxray
