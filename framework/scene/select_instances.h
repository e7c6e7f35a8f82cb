#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace voxray {

/// Removes instances for which `isKept` is false. Nodes, materials, lights and the content hash don't change.
void filterInstances(Scene& scene, const std::function<bool(const Instance&)>& isKept);

/// Nonempty names of an instance's mesh, material, node and ancestors.
std::vector<std::string> namesOfInstance(const Scene& scene, const Instance& instance);

/// Removes all instances with a name. @return their number
size_t hide(Scene& scene, const std::string& name);

}  // namespace voxray
