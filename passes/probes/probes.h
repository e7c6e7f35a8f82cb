#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/probes/probe_types.h"

namespace voxray {

/// Irradiance probes: in the points of one grid or more, irradiance by normal and moments of the distance of
/// surfaces by direction, each as an octahedral map. GLSL access: passes/probes/probe_lookup.glsl. Source: Majercik
/// et al. 2019; docs/probes.md.
struct Probes : Resource {
    Buffer grids;      ///< gpu::ProbeSettings, then a gpu::ProbeGrid for each cascade, the finest first.
    Buffer states;     ///< gpu::ProbeState each.
    Image irradiance;  ///< RGBA16F, 3D: encoded irradiance.
    Image depth;       ///< RG16F, 3D: mean distance and mean squared distance, in smallest spacings.
    Sampler sampler;   ///< Linear.

    /// For shaders that include probe_grid.glsl or probe_lookup.glsl.
    std::vector<Binding> bindings() const {
        return {ifUsed({"probeGrids", grids}), ifUsed({"probeStates", states}),
                ifUsed({"probeIrradiance", irradiance, sampler}), ifUsed({"probeDepth", depth, sampler})};
    }
    std::vector<Elements> elements() const override { return {{&states, Elements::Type::Float32, 4}}; }
};

}  // namespace voxray
