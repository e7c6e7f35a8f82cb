#pragma once

#include <string>

namespace voxray::test {

/// A strategy of injection, with parameters for small scenes, after place_surfels, link_surfels and
/// trace_gather_rays.
struct Injection {
    std::string pass;         ///< And its parameters but for `bounces`.
    bool takesEmission;       ///< Whether emissive surfaces may be sources; point, spot and directional lights may.
    bool fromCamera = false;  ///< Lights only voxels that the camera's rays or their reflections meet.

    std::string withBounces(int bounces) const { return pass + ", bounces: " + std::to_string(bounces); }
};

inline const Injection kInjections[] = {
    {"inject_light_rays, rays_per_light: 131072", true},
    {"inject_voxel_rays, paths_per_point: 2", true},
    {"inject_radiosity", true},
    {"inject_voxel_rays, points: gather_hits, paths_per_point: 2", true, true},
    {"inject_camera_rays, rays_per_image: 65536", true, true},
    {"inject_rsm, rsm_resolution: 128", false},
    {"inject_voxel_rays, direct: shadow_maps, shadow_resolution: 256, paths_per_point: 2", false},
};

}  // namespace voxray::test
