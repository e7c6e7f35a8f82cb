#pragma once

#include <array>
#include <string_view>

#include "graph/registry.h"

namespace voxray {

/// A folder under passes/ whose techniques share code.
struct Family {
    std::string_view folder;
    std::string_view title;
    bool isForExperiments = false;  ///< Listed by `./voxray passes --experiments` only.
};

/// In the order of the pipeline.
inline constexpr std::array kFamilies{
    Family{"view", "What the camera sees: G-buffer, direct light, filters of images"},
    Family{"voxels", "Voxels of surfaces"},
    Family{"inject", "Injection of light into voxels: light rays, reflective shadow maps, shadow rays"},
    Family{"surfels", "Surfels: points of surfaces"},
    Family{"radiosity", "Radiosity between surfels"},
    Family{"clusters", "Clusters of voxels and visibility between them"},
    Family{"cones", "Prefiltered radiance voxels and cone tracing"},
    Family{"final_gather", "Rays from what the camera sees to stored light"},
    Family{"reservoirs", "Reservoir resampling of gather rays"},
    Family{"cache", "Hashed radiance cache"},
    Family{"probes", "Irradiance probes"},
    Family{"vpls", "Virtual point lights"},
    Family{"hybrid_leaves", "Voxels with triangles as leaves; mirrors"},
    Family{"published", "As published, for comparison"},
    Family{"path_trace", "Reference"},
    Family{"external", "Images of other renderers"},
    Family{"experiments", "Measurements for experiments; no image depends on them", true},
};

/// Adds every technique under passes/, by family.
void registerPasses(Registry& registry);

}  // namespace voxray
