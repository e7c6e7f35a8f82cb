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

}  // namespace voxray::pbrt
