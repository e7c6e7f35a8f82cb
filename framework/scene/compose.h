#pragma once

#include "base/schema.h"
#include "scene/scene.h"

namespace voxray {

/// Transform of a scene: scaled, then rotated about the axes X, Y and Z in this order, then translated.
struct Placement {
    glm::vec3 translate{0.0f};
    glm::vec3 rotateDegrees{0.0f};
    glm::vec3 scale{1.0f};
    static constexpr auto schema() {
        return std::tuple{field("translate", &Placement::translate, "Position of the scene's origin, m.",
                                glm::vec3(-1e6f), glm::vec3(1e6f))
                              .asVector(),
                          field("rotate_deg", &Placement::rotateDegrees,
                                "Rotation about the axes X, Y and Z, in this order, degrees, "
                                "counter-clockwise seen from the axis' end.",
                                glm::vec3(-360.0f), glm::vec3(360.0f))
                              .asVector(),
                          field("scale", &Placement::scale,
                                "Factor of lengths, one for all axes or one per axis; negative ones mirror. Not 0.",
                                glm::vec3(-1e6f), glm::vec3(1e6f))};
    }
};

/// Adds surfaces, materials, punctual lights and animation of another scene below a new node with this
/// transform. The added scene's cameras and environment are ignored. The content hash is not updated.
/// @param name of the new node
/// @param material replaces all materials of the added scene; nullptr: none
void addScene(Scene& scene, const Scene& added, const Placement& placement, const std::string& name,
              const Material* material = nullptr);

/// The scene below a new node with this transform: surfaces, punctual lights, cameras and animation. Light
/// intensities and the environment's orientation don't change. The content hash is empty.
Scene placedScene(const Scene& scene, const Placement& placement);

}  // namespace voxray
