#pragma once

#include "base/schema.h"
#include "scene/scene.h"

namespace voxray {

/// Lambert spheres in a cubic lattice that oscillate together along a line, at constant speed. They fill the
/// lattice row by row, then layer by layer upwards: 9 are one layer of 3 x 3, 27 three of them.
struct MovingSpheres {
    uint32_t count = 1;
    float radius = 0.25f;
    glm::vec3 center{0.0f};
    float spacing = 1.0f;
    glm::vec3 swing{1, 0, 0};
    float period = 4.0f;
    glm::vec3 albedo{0.5f};
    static constexpr auto schema() {
        return std::tuple{
            field("count", &MovingSpheres::count, "Number of spheres; 0: none.", 0u, 4096u),
            field("radius", &MovingSpheres::radius, "Radius of the spheres, m.", 0.001f, 1000.0f),
            field("center", &MovingSpheres::center, "Center of the lattice at time 0, m.", glm::vec3(-1e6f),
                  glm::vec3(1e6f))
                .asVector(),
            field("spacing", &MovingSpheres::spacing, "Distance between adjacent centers, m.", 0.0f, 1e4f),
            field("swing", &MovingSpheres::swing,
                  "Vector that each moves from its center; then as far in the opposite direction, m.", glm::vec3(-1e4f),
                  glm::vec3(1e4f))
                .asVector(),
            field("period", &MovingSpheres::period, "Duration of a whole oscillation, s.", 0.001f, 1e6f),
            field("albedo", &MovingSpheres::albedo, "Albedo of all spheres.", glm::vec3(0.0f), glm::vec3(1.0f))};
    }
};

/// Adds the spheres to a scene, each a node with an animation channel. The content hash is not updated.
void addMovingSpheres(Scene& scene, const MovingSpheres& spheres);

}  // namespace voxray
