#pragma once

#include <numbers>

#include "passes/vpls/vpls.h"
#include "tests/gpu/chain.h"

namespace voxray::test {

inline constexpr double kPi = std::numbers::pi;

inline const Vpls& vpls(const Chain& chain) {
    return *chain.graph().resource<Vpls>("vpls");
}

/// A graph of virtual lights by these parameters of sample_vpls and of gather_vpls.
inline std::string manyLights(const std::string& sample, const std::string& gather) {
    return graphYaml(
        {"gbuffer", "voxelize, resolution: 32", "sample_vpls, " + sample, "gather_vpls, " + gather});
}

/// Indirect light of a built-in scene.
inline std::vector<float> indirectLight(const std::string& scene, const std::string& parameters,
                                        const std::string& graph, uint32_t side = 32) {
    return Chain(scene, parameters, graph, side, side).image("indirect").data;
}

}  // namespace voxray::test
