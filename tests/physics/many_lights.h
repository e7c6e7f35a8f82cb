#pragma once

#include "passes/vpls/vpls.h"
#include "tests/gpu/chain.h"

namespace voxray::test {

inline const Vpls& vpls(const Chain& chain) {
    return chain.get<Vpls>("vpls");
}

/// A graph of virtual lights by these parameters of sample_vpls and of gather_vpls.
inline std::string manyLights(const std::string& sample, const std::string& gather) {
    return graphYaml({"gbuffer", "voxelize, resolution: 32", "sample_vpls, " + sample, "gather_vpls, " + gather});
}

/// Flux of virtual lights by their bounce.
inline std::vector<double> fluxByBounce(Chain& chain, size_t bounces) {
    const auto points = chain.read<gpu::Vpl>(vpls(chain).points);
    const auto list = chain.read<uint32_t>(vpls(chain).activeIndices);
    std::vector<double> flux(bounces);
    for (uint32_t i = 0; i < vpls(chain).activeCount; ++i) flux.at(list[i] % bounces) += points.at(list[i]).flux.y;
    return flux;
}

}  // namespace voxray::test
