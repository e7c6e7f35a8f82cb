#pragma once

#include <string>

#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

/// Describes a 3D texture of half floats that the device's sampler filters, for `radiance`.
/// @param pass, remedy for errors: who asks, and what to set in place of it ("set 'layout' to dense").
/// @throws Error where the device can't make one of this size.
void planRadianceTexture(PassPlan& plan, const std::string& pass, const std::string& remedy,
                         glm::uvec3 extent, uint32_t mipLevels, RadianceVoxels& radiance);

/// Clears it, since filtering reads texels round those that hold voxels with a weight of 0, and makes its
/// sampler.
void prepareRadianceTexture(PassSetup& setup, RadianceVoxels& radiance);

}  // namespace voxray
