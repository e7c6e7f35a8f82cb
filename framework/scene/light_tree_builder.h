#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/bounded_light.h"
#include "shaders/scene/light_tree_types.h"

namespace voxray {

struct LightTreeNodes {
    std::vector<gpu::LightTreeNode> nodes;  ///< The root is the first.
    std::vector<uint32_t> leaves;           ///< The node of each light.
};

/// Builds a tree from the top (Conty Estevez and Kulla 2018, section 4.4). Equal for equal lights.
/// @param firstGroup The first so many lights are the root's first child, the others its second; 0, or all: no groups.
/// @throws Error for more lights than a node can number.
LightTreeNodes buildLightTree(std::span<const BoundedLight> lights, size_t firstGroup);

}  // namespace voxray
