#include "scene/select_instances.h"

#include <algorithm>

namespace voxray {

void filterInstances(Scene& scene, const std::function<bool(const Instance&)>& isKept) {
    std::erase_if(scene.instances, [&](const Instance& instance) { return !isKept(instance); });

    // Unused meshes are emptied, which keeps indices
    std::vector<bool> isShown(scene.meshes.size());
    for (const Instance& instance : scene.instances) isShown[instance.mesh] = true;
    for (size_t i = 0; i < scene.meshes.size(); ++i)
        if (!isShown[i]) {
            Mesh empty;
            empty.name = scene.meshes[i].name;
            empty.material = scene.meshes[i].material;
            scene.meshes[i] = std::move(empty);
        }
}

std::vector<std::string> namesOfInstance(const Scene& scene, const Instance& instance) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    std::vector<std::string> names{mesh.name, scene.materials[mesh.material].name};
    for (int32_t node = instance.node; node >= 0; node = scene.nodes[size_t(node)].parent)
        names.push_back(scene.nodes[size_t(node)].name);
    std::erase(names, "");
    return names;
}

size_t hide(Scene& scene, const std::string& name) {
    const size_t before = scene.instances.size();
    filterInstances(scene, [&](const Instance& instance) {
        return std::ranges::count(namesOfInstance(scene, instance), name) == 0;
    });
    return before - scene.instances.size();
}

}  // namespace voxray
