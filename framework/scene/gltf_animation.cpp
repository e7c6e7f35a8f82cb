#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "scene/gltf_accessor.h"
#include "scene/gltf_nodes.h"
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

/// Reads keys; rotations become unit quaternions, the tangents of a spline stay as they are.
void readKeys(GltfFile& file, const tinygltf::AnimationSampler& sampler, AnimationChannel& channel,
              const std::string& what) {
    if (sampler.interpolation == "LINEAR")
        channel.interpolation = Interpolation::Linear;
    else if (sampler.interpolation == "STEP")
        channel.interpolation = Interpolation::Step;
    else if (sampler.interpolation == "CUBICSPLINE")
        channel.interpolation = Interpolation::CubicSpline;
    else
        file.fail("{}: interpolation '{}' is not one of glTF's", what, sampler.interpolation);
    channel.timesSeconds = readTimes(file, sampler.input, what);

    const bool rotation = channel.property == AnimatedProperty::Rotation;
    const bool cubic = channel.interpolation == Interpolation::CubicSpline;
    const uint32_t components = rotation ? 4 : 3;
    const AccessorValues values = readAccessor(file, sampler.output, components, components, "animation values");
    const size_t expected = channel.timesSeconds.size() * (cubic ? 3 : 1);
    if (values.count != expected) file.fail("{}: {} values for {} keys", what, values.count, expected);
    file.reserve(values.count, sizeof(glm::vec4));
    channel.values.resize(values.count);
    for (size_t i = 0; i < values.count; ++i) {
        glm::vec4& value = channel.values[i];
        for (uint32_t c = 0; c < 4; ++c) {
            value[int(c)] = values.get(i, c);
            if (!(std::abs(value[int(c)]) <= float(maxNumber))) file.fail("{}: value {} is not finite", what, i);
        }
        if (!rotation || (cubic && i % 3 != 1)) continue;
        const float length = glm::length(value);
        if (!(length > 0)) file.fail("{}: rotation {} is zero", what, i);
        value /= length;
    }
}

}  // namespace

void readAnimations(GltfFile& file, const std::vector<int>& fileNodes, Scene& scene) {
    std::vector<int32_t> sceneNode(file.model().nodes.size(), -1);
    for (size_t i = 0; i < fileNodes.size(); ++i) sceneNode[size_t(fileNodes[i])] = int32_t(i);

    std::set<std::pair<uint32_t, AnimatedProperty>> animated;
    for (size_t a = 0; a < file.model().animations.size(); ++a) {
        const tinygltf::Animation& animation = file.model().animations[a];
        for (const tinygltf::AnimationChannel& source : animation.channels) {
            // Find what it moves.
            const std::string what = fmt::format("animation {} '{}'", a, shortLine(animation.name));
            if (source.target_node < 0) continue;
            file.at(sceneNode, source.target_node, "node");
            if (sceneNode[size_t(source.target_node)] < 0) continue;
            AnimationChannel channel;
            channel.node = uint32_t(sceneNode[size_t(source.target_node)]);
            if (source.target_path == "translation") {
                channel.property = AnimatedProperty::Translation;
            } else if (source.target_path == "rotation") {
                channel.property = AnimatedProperty::Rotation;
            } else if (source.target_path == "scale") {
                channel.property = AnimatedProperty::Scale;
            } else {
                file.warn("{}: animated {} are not supported; those of the file's rest pose stay", what,
                          source.target_path);
                continue;
            }
            if (scene.nodes[channel.node].matrix) {
                file.warn("{}: node {} has a matrix, which can't be animated; left out", what, source.target_node);
                continue;
            }
            if (!animated.insert({channel.node, channel.property}).second) {
                file.warn("{}: {} of node {} is animated twice; the first counts", what, source.target_path,
                          source.target_node);
                continue;
            }
            readKeys(file, file.at(animation.samplers, source.sampler, "animation sampler"), channel, what);
            scene.animation.push_back(std::move(channel));
        }
    }
}

}  // namespace voxray
