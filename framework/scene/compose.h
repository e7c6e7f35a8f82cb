#pragma once

#include "base/schema.h"
#include "scene/scene.h"

namespace voxray {

/// How a scene is placed: scaled, then rotated about the axes X, Y and Z in this order, then moved.
struct Placement {
    glm::vec3 translate{0.0f};
    glm::vec3 rotateDegrees{0.0f};
    glm::vec3 scale{1.0f};
    static constexpr auto schema() {
        return std::tuple{
            field("translate", &Placement::translate, "Where the scene's origin goes, metres.",
                  glm::vec3(-1e6f), glm::vec3(1e6f))
                .asVector(),
            field("rotate_deg", &Placement::rotateDegrees,
                  "Degrees about the axes X, Y and Z, in this order, counter-clockwise seen from the axis' "
                  "end.",
                  glm::vec3(-360.0f), glm::vec3(360.0f))
                .asVector(),
            field("scale", &Placement::scale,
                  "Factor of lengths, one or one an axis; negative ones mirror. Not 0.", glm::vec3(-1e6f),
                  glm::vec3(1e6f))};
    }
};

/// Adds what another scene shows to a scene: surfaces, materials, punctual lights and animation, below one
/// new node that places them. Cameras and the environment of the added scene are left out.
/// @param name of the new node
/// @param material stands in for all materials of the added scene; nullptr: they stay. The content hash
/// stays.
void addScene(Scene& scene, const Scene& added, const Placement& placement, const std::string& name,
              const Material* material = nullptr);

/// The scene below one new node that places it: surfaces, punctual lights, cameras and animation. Lights keep
/// their intensity, the environment its directions. The content hash is left empty.
Scene placedScene(const Scene& scene, const Placement& placement);

}  // namespace voxray
