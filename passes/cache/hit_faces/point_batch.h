#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/surfels/surfel_direct_light.h"

namespace voxray {

/// Points of faces that are lit at a time: their surfels, rays from them and what is measured there.
struct PointBatch {
    explicit PointBatch(ProgramOwner& owner) : directLight(owner) {}

    /// @param lightSamples shadow rays from a point to the emissive surfaces, and to the environment.
    /// @param points as many are lit at a time, unless memory bounds them.
    void plan(PassPlan& plan, std::vector<LightSource> lights, uint32_t lightSamples, uint64_t points);
    /// Measures direct light at the first `count` surfels, of all sources or of these.
    void measure(PassContext& context, uint32_t count, uint32_t seed) const { measure(context, sources, count, seed); }
    void measure(PassContext& context, const std::vector<LightSource>& lights, uint32_t count, uint32_t seed) const {
        directLight.measure(context, lights, surfels, count, samples, seed, direct);
    }

    SurfelDirectLight directLight;
    std::vector<LightSource> sources;
    uint32_t samples = 1;
    uint32_t size = 0;           ///< Most points.
    Buffer surfels, rays, hits;  ///< gpu::Surfel, Ray, Hit
    Buffer direct;               ///< vec4, W/m²
};

/// Makes a buffer of at least `bytes` that keeps its first `kept` bytes. Waits for the device.
void grow(Buffer& buffer, PassContext& context, const char* name, uint64_t bytes, uint64_t kept);

}  // namespace voxray
