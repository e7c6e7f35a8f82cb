#include "scene/compose.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace voxray {
namespace {

Node nodeOf(const Placement& placement, const std::string& name) {
    const glm::vec3 angles = glm::radians(placement.rotateDegrees);
    return {.name = name,
            .translation = placement.translate,
            .rotation = glm::angleAxis(angles.z, glm::vec3(0, 0, 1)) * glm::angleAxis(angles.y, glm::vec3(0, 1, 0)) *
                        glm::angleAxis(angles.x, glm::vec3(1, 0, 0)),
            .scale = placement.scale};
}

/// A direction transformed by a node, not normalized.
glm::vec3 transformed(const Node& node, const glm::vec3& vector) {
    return node.rotation * (node.scale * vector);
}

/// Copies textures and materials. @return the index of the first of these materials.
uint32_t addMaterials(Scene& scene, const Scene& added) {
    const int32_t firstTexture = int32_t(scene.textures.size());
    const uint32_t firstMaterial = uint32_t(scene.materials.size());
    scene.textures.insert(scene.textures.end(), added.textures.begin(), added.textures.end());
    for (Material material : added.materials) {
        for (TextureRef* ref : {&material.baseColorTexture, &material.metallicRoughnessTexture, &material.normalTexture,
                                &material.emissiveTexture})
            if (ref->texture >= 0) ref->texture += firstTexture;
        scene.materials.push_back(std::move(material));
    }
    return firstMaterial;
}

}  // namespace

void addScene(Scene& scene, const Scene& added, const Placement& placement, const std::string& name,
              const Material* material) {
    // Nodes, below the new one
    const int32_t root = int32_t(scene.nodes.size());
    const auto numberOf = [&](int32_t node) { return node < 0 ? root : root + 1 + node; };
    const Node placing = nodeOf(placement, name);
    scene.nodes.push_back(placing);
    for (Node node : added.nodes) {
        node.parent = numberOf(node.parent);
        scene.nodes.push_back(std::move(node));
    }
    for (AnimationChannel channel : added.animation) {
        channel.node = uint32_t(numberOf(int32_t(channel.node)));
        scene.animation.push_back(std::move(channel));
    }

    // Surfaces
    const uint32_t firstMaterial = material ? uint32_t(scene.materials.size()) : addMaterials(scene, added);
    if (material) scene.materials.push_back(*material);
    const uint32_t firstMesh = uint32_t(scene.meshes.size());
    for (Mesh mesh : added.meshes) {
        mesh.material = firstMaterial + (material ? 0 : mesh.material);
        scene.meshes.push_back(std::move(mesh));
    }
    const int32_t firstSkin = int32_t(scene.skins.size());
    for (Skin skin : added.skins) {
        for (uint32_t& joint : skin.joints) joint = uint32_t(numberOf(int32_t(joint)));
        scene.skins.push_back(std::move(skin));
    }
    const int32_t firstMorph = int32_t(scene.morphs.size());
    scene.morphs.insert(scene.morphs.end(), added.morphs.begin(), added.morphs.end());
    for (const Instance& instance : added.instances)
        scene.instances.push_back({firstMesh + instance.mesh, numberOf(instance.node),
                                   instance.skin < 0 ? -1 : firstSkin + instance.skin,
                                   instance.morph < 0 ? -1 : firstMorph + instance.morph});

    // Lights; those without a node are in the added scene's world space
    for (Light light : added.lights) {
        if (light.node < 0) {
            light.position = placement.translate + transformed(placing, light.position);
            light.direction = glm::normalize(transformed(placing, light.direction));
        } else {
            light.node = numberOf(light.node);
        }
        scene.lights.push_back(std::move(light));
    }
}

Scene placedScene(const Scene& scene, const Placement& placement) {
    Scene placed;
    placed.name = scene.name;
    placed.environment = scene.environment;
    placed.warnings = scene.warnings;
    placed.orthographicCameras = scene.orthographicCameras;
    addScene(placed, scene, placement, scene.name);

    // Cameras; those without a node are in the scene's world space
    const Node& placing = placed.nodes.front();
    for (Camera camera : scene.cameras) {
        if (camera.node < 0) {
            camera.position = placement.translate + transformed(placing, camera.position);
            camera.forward = glm::normalize(transformed(placing, camera.forward));
            const glm::vec3 up = transformed(placing, camera.up);
            camera.up = glm::normalize(up - glm::dot(up, camera.forward) * camera.forward);
        } else {
            ++camera.node;
        }
        placed.cameras.push_back(std::move(camera));
    }
    return placed;
}

}  // namespace voxray
