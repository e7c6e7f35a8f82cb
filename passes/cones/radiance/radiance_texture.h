#pragma once

#include <string>

#include "passes/cones/radiance/radiance_voxels.h"

namespace voxray {

/// Describes a 3D texture of half floats for `radiance`, filtered by the sampler.
/// @param pass, remedy for errors: the pass's name, and what to set instead ("set 'layout' to dense").
/// @throws Error if the device can't make one of this size.
void planRadianceTexture(PassPlan& plan, const std::string& pass, const std::string& remedy, glm::uvec3 extent,
                         uint32_t mipLevels, RadianceVoxels& radiance);

/// Clears the texture, since filtering reads unused texels with a weight of 0, and makes its sampler.
void prepareRadianceTexture(PassSetup& setup, RadianceVoxels& radiance);

}  // namespace voxray
