#include <glm/geometric.hpp>
#include <set>

#include "scene/gltf_keys.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_values.h"

namespace voxray {
namespace {

/// Reads the keys of a node's property; rotations become unit quaternions, the tangents of a spline stay as
/// they are.
void readChannel(GltfFile& file, const tinygltf::AnimationSampler& sampler, AnimationChannel& channel,
                 const std::string& what) {
    const bool rotation = channel.property == AnimatedProperty::Rotation;
    AnimationKeys keys = readKeys(file, sampler, rotation ? 4 : 3, 1, what);
    channel.interpolation = keys.interpolation;
    channel.timesSeconds = std::move(keys.timesSeconds);
    const bool cubic = channel.interpolation == Interpolation::CubicSpline;
    file.reserve(keys.values.count, sizeof(glm::vec4));
    channel.values.resize(keys.values.count);
    for (size_t i = 0; i < keys.values.count; ++i) {
        glm::vec4& value = channel.values[i];
        for (uint32_t c = 0; c < 4; ++c) value[int(c)] = keys.values.get(i, c);
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
            if (source.target_node < 0 || source.target_path == "weights") continue;
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
                file.warn("{}: animated '{}' is not supported; that of the file's rest pose stays", what,
                          shortLine(source.target_path));
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
            readChannel(file, file.at(animation.samplers, source.sampler, "animation sampler"), channel, what);
            scene.animation.push_back(std::move(channel));
        }
    }
}

}  // namespace voxray
