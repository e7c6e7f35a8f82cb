#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace voxray {

/// Leaves those instances out of a scene that `isKept` refuses. Nodes, materials, lights and the content hash
/// stay.
void keepInstances(Scene& scene, const std::function<bool(const Instance&)>& isKept);

/// Names that an instance goes by: of its mesh, its material, its node and the nodes above it; none is empty.
std::vector<std::string> namesOfInstance(const Scene& scene, const Instance& instance);

/// Leaves every instance out that goes by a name. @return how many there were
size_t hide(Scene& scene, const std::string& name);

}  // namespace voxray
