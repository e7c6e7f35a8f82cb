#pragma once

#include <glm/mat4x4.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/pbrt/parameters.h"

/// What a pbrt file describes, before anything is made of it: names may be used before they are defined.
namespace voxray::pbrt {

using ParametersPtr = std::shared_ptr<const Parameters>;

struct Texture {
    ParametersPtr parameters;
    glm::dmat4 toWorld{1.0};
};

/// The material of a shape: its own, or one by name.
struct MaterialUse {
    ParametersPtr material;  ///< nullptr: the named one.
    std::string name;
    TextLocation where;
};

struct Shape {
    ParametersPtr parameters;
    glm::dmat4 toWorld{1.0};
    bool isReversed = false;  ///< ReverseOrientation.
    MaterialUse material;
    ParametersPtr areaLight;  ///< nullptr: it does not shine.
};

struct Light {
    ParametersPtr parameters;
    glm::dmat4 toWorld{1.0};
};

struct Instance {
    std::string object;
    glm::dmat4 toWorld{1.0};
    TextLocation where;
};

struct Description {
    std::optional<Light> camera;
    ParametersPtr film;
    std::map<std::string, Texture> floatTextures;
    std::map<std::string, Texture> colorTextures;
    std::map<std::string, ParametersPtr> materials;  ///< Named ones.
    std::vector<Shape> shapes;
    std::vector<Light> lights;
    std::map<std::string, std::vector<Shape>> objects;
    std::vector<Instance> instances;
};

}  // namespace voxray::pbrt
