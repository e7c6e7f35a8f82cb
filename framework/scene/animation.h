#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "scene/scene.h"

namespace voxray {

/// Value of a channel at a time: xyz, or a unit quaternion (x, y, z, w) for rotations. Times before the first
/// key and after the last one take that key's value. Source: glTF 2.0, appendix C.
glm::vec4 sampleChannel(const AnimationChannel& channel, double timeSeconds);

/// World matrix of every node at a time, in the order of Scene::nodes.
/// @throws Error naming the node whose matrix is not finite.
std::vector<glm::mat4> nodeToWorld(const Scene& scene, double timeSeconds);

/// A time within the animation's span, which repeats from 0 s to the last key; 0 where nothing is animated.
double loopedTime(const Scene& scene, double timeSeconds);

}  // namespace voxray
