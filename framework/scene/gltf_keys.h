#pragma once

#include <string>
#include <vector>

#include "scene/gltf_accessor.h"
#include "scene/interpolation.h"

namespace voxray {

/// Keys of an animation's sampler. Where they are splines each has in-tangents, values and out-tangents.
struct AnimationKeys {
    Interpolation interpolation = Interpolation::Linear;
    std::vector<float> timesSeconds;
    AccessorValues values;  ///< In [-1e30, 1e30].
};

/// @param components of a value. @param valuesOfKey values of a key, a spline's tangents apart.
/// @param what names the animation in messages
/// @throws Error for another number of values, times that decrease and numbers that are not finite
AnimationKeys readKeys(GltfFile& file, const tinygltf::AnimationSampler& sampler, uint32_t components,
                       size_t valuesOfKey, const std::string& what);

}  // namespace voxray
