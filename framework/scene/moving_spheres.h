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
            field("radius", &MovingSpheres::radius, "In metres.", 0.001f, 1000.0f),
            field("center", &MovingSpheres::center, "Center of the lattice at time 0, metres.",
                  glm::vec3(-1e6f), glm::vec3(1e6f))
                .asVector(),
            field("spacing", &MovingSpheres::spacing, "Between the centers of neighbours, metres.", 0.0f,
                  1e4f),
            field("swing", &MovingSpheres::swing,
                  "How far each moves from its place, to this side and then as far to the other, metres.",
                  glm::vec3(-1e4f), glm::vec3(1e4f))
                .asVector(),
            field("period", &MovingSpheres::period, "Seconds of a whole swing, to both sides and back.",
                  0.001f, 1e6f),
            field("albedo", &MovingSpheres::albedo, "Of all spheres.", glm::vec3(0.0f), glm::vec3(1.0f))};
    }
};

/// Adds the spheres to a scene, each a node with an animation channel. The content hash is not updated.
void addMovingSpheres(Scene& scene, const MovingSpheres& spheres);

}  // namespace voxray
