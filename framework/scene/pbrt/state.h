#pragma once

#include <map>

#include "scene/pbrt/description.h"

namespace voxray::pbrt {

/// What AttributeBegin saves and AttributeEnd restores.
struct State {
    glm::dmat4 transform{1.0};  ///< At the start of the shutter.
    bool setsStart = true;      ///< Whether ActiveTransform lets transforms change it.
    bool isReversed = false;
    std::string colorSpace = "srgb";
    MaterialUse material;
    ParametersPtr areaLight;
    /// Parameters of `Attribute`, by what they are for: "shape", "light" ... Shared by saved states.
    using Defaults = std::map<std::string, std::vector<std::shared_ptr<const Parameter>>>;
    std::shared_ptr<const Defaults> defaults = std::make_shared<Defaults>();
};

/// From the camera's space to the world's inverse: pbrt's LookAt, whose Z is the direction of view.
/// @throws Error at a place where eye and target are one point
glm::dmat4 lookAtMatrix(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up,
                        const TextLocation& where);

}  // namespace voxray::pbrt
