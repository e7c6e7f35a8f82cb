#pragma once

#include <string>
#include <vector>

#include "graph/pass.h"

namespace voxray {

/// What gather rays bring, ray by ray, in the batches of their GatherHits.
struct GatherLight : Resource {
    /// vec4 per ray. rgb: π times the radiance that arrives, W/m²; w: distance of the hit, m, 1e30 for a
    /// miss, -1 for a ray that starts from no surface.
    std::vector<Buffer> light;
    /// float per ray: the gather shades hits closer than this in another way than those beyond, so the light
    /// of a ray holds for other receivers on the same side of this distance only; m, 0: for all.
    std::vector<Buffer> nearDistances;

    std::string indexedBy() const override { return "gather_hits"; }
    std::vector<const Buffer*> checkedBuffers() const override {
        std::vector<const Buffer*> all;
        for (const Buffer& batch : light) all.push_back(&batch);
        return all;
    }
    std::vector<Elements> elements() const override {
        std::vector<Elements> all;
        for (const Buffer& batch : light) all.push_back({&batch, Elements::Type::Float32, 4});
        for (const Buffer& batch : nearDistances) all.push_back({&batch, Elements::Type::Float32, 1});
        return all;
    }
};

}  // namespace voxray
