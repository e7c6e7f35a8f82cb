#include "scene/moving_spheres.h"

#include "scene/shapes.h"
#include "scene/swing.h"

namespace voxray {

void addMovingSpheres(Scene& scene, const MovingSpheres& spheres) {
    if (spheres.count == 0) return;

    // One shared mesh of 1280 triangles.
    scene.materials.push_back(
        {.name = "moving sphere", .baseColor = glm::vec4(spheres.albedo, 1.0f), .metallic = 0, .specular = 0});
    const uint32_t mesh = uint32_t(scene.meshes.size());
    scene.meshes.push_back(sphereMesh("moving sphere", glm::vec3(0.0f), spheres.radius, 3,
                                      uint32_t(scene.materials.size() - 1), false, true));

    // The smallest lattice of n x n x n that holds all, centered by its filled layers.
    uint32_t n = 1;
    while (n * n * n < spheres.count) ++n;
    const uint32_t layers = (spheres.count + n * n - 1) / (n * n);
    const glm::vec3 half = 0.5f * glm::vec3(n - 1, layers - 1, n - 1);
    for (uint32_t i = 0; i < spheres.count; ++i) {
        const glm::vec3 cell(i % n, i / (n * n), i / n % n);
        const glm::vec3 position = spheres.center + spheres.spacing * (cell - half);
        scene.animation.push_back(
            translationOf({spheres.swing, spheres.period}, uint32_t(scene.nodes.size()), position));
        scene.instances.push_back({mesh, int32_t(scene.nodes.size())});
        scene.nodes.push_back({.name = fmt::format("moving sphere {}", i), .translation = position});
    }
}

}  // namespace voxray
