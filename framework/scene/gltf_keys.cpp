#include "scene/gltf_keys.h"

#include <algorithm>
#include <cmath>

#include "scene/gltf_values.h"

namespace voxray {
namespace {

std::vector<float> readTimes(GltfFile& file, int accessor, const std::string& what) {
    const std::vector<float> times = readAccessor(file, accessor, 1, 1, "animation times").data;
    if (times.empty()) file.fail("{}: it has no keys", what);
    for (size_t i = 0; i < times.size(); ++i)
        if (!std::isfinite(times[i]) || (i > 0 && times[i] < times[i - 1]))
            file.fail("{}: its times are not increasing at key {}", what, i);
    if (std::adjacent_find(times.begin(), times.end()) != times.end())
        file.warn("{}: its times repeat; it jumps to the last key of a time", what);
    return times;
}

Interpolation interpolationOf(GltfFile& file, const std::string& name, const std::string& what) {
    if (name == "LINEAR") return Interpolation::Linear;
    if (name == "STEP") return Interpolation::Step;
    if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
    file.fail("{}: interpolation '{}' is not one of glTF's", what, name);
}

}  // namespace

AnimationKeys readKeys(GltfFile& file, const tinygltf::AnimationSampler& sampler, uint32_t components,
                       size_t valuesOfKey, const std::string& what) {
    AnimationKeys keys;
    keys.interpolation = interpolationOf(file, sampler.interpolation, what);
    keys.timesSeconds = readTimes(file, sampler.input, what);
    keys.values = readAccessor(file, sampler.output, components, components, "animation values");
    const size_t count = keys.timesSeconds.size() * (keys.interpolation == Interpolation::CubicSpline ? 3 : 1);
    if (valuesOfKey == 1 && keys.values.count != count)
        file.fail("{}: {} values for {} keys", what, keys.values.count, count);
    if (keys.values.count != count * valuesOfKey)
        file.fail("{}: {} values for {} keys of {} weights, one for each morph target; export the animation anew", what,
                  keys.values.count, count, valuesOfKey);
    for (size_t i = 0; i < keys.values.data.size(); ++i)
        if (!(std::abs(keys.values.data[i]) <= float(maxNumber)))
            file.fail("{}: value {} is not finite", what, i / components);
    return keys;
}

}  // namespace voxray
