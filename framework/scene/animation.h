#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "scene/scene.h"

namespace voxray {

/// Value of a channel at a time: xyz, or a unit quaternion (x, y, z, w) for rotations. Times are clamped to
/// the keys. Source: glTF 2.0, appendix C.
glm::vec4 sampleChannel(const AnimationChannel& channel, double timeSeconds);

/// Weights of all morph targets at a time, clamped likewise.
std::vector<float> sampleWeights(const MorphChannel& channel, double timeSeconds);

/// Whether nodes or weights of morph targets have keys.
bool isAnimated(const Scene& scene);

/// World matrix of every node at a time, in the order of Scene::nodes.
/// @throws Error naming the node whose matrix is not finite.
std::vector<glm::mat4> nodeToWorld(const Scene& scene, double timeSeconds);

/// The time modulo that of the last key, s; 0 without animation.
double loopedTime(const Scene& scene, double timeSeconds);

}  // namespace voxray
