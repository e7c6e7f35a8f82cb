#pragma once

#include <string>
#include <vector>

#include "base/schema.h"
#include "scene/scene.h"

namespace voxray {

/// A material in a config; by default a white dielectric.
struct MaterialSettings {
    glm::vec3 baseColor{1.0f};
    float metallic = 0;
    float roughness = 1;
    float specular = 1;
    glm::vec3 emission{0.0f};
    float normalScale = 1;
    bool doubleSided = false;
    static constexpr auto schema() {
        return std::tuple{
            field("base_color", &MaterialSettings::baseColor, "Base colour, linear Rec.709; removes its texture.",
                  glm::vec3(0.0f), glm::vec3(1.0f)),
            field("metallic", &MaterialSettings::metallic,
                  "0: dielectric, 1: metal; removes the texture of metallic and roughness.", 0.0f, 1.0f),
            field("roughness", &MaterialSettings::roughness,
                  "0: mirror-like; removes the texture of metallic and roughness.", 0.0f, 1.0f),
            field("specular", &MaterialSettings::specular,
                  "Strength of a dielectric's reflection; 0 with metallic 0 is exactly Lambert.", 0.0f, 1.0f),
            field("emission", &MaterialSettings::emission, "Emitted radiance, W/(m² sr); removes its texture.",
                  glm::vec3(0.0f), glm::vec3(1e12f)),
            field("normal_scale", &MaterialSettings::normalScale, "Strength of the normal map; 0: a smooth surface.",
                  0.0f, 100.0f),
            field("double_sided", &MaterialSettings::doubleSided, "Whether it emits on both sides.")};
    }
};

/// New values for some of a material's settings.
struct MaterialChange {
    MaterialSettings settings;
    std::vector<std::string> keys;  ///< Names of the settings that change.
};

/// Sets factors of a material and removes the textures that would multiply them. Vertex colours still
/// multiply the base colour. A new base colour makes a masked material opaque.
void changeMaterial(Material& material, const MaterialChange& change);

/// A material of these settings, without textures.
Material makeMaterial(const std::string& name, const MaterialSettings& settings);

}  // namespace voxray
