#include "scene/material_change.h"

#include <algorithm>

namespace voxray {

void changeMaterial(Material& material, const MaterialChange& change) {
    const MaterialSettings& settings = change.settings;
    const auto isGiven = [&](const char* key) { return std::ranges::count(change.keys, key) > 0; };
    if (isGiven("base_color")) {
        material.baseColor = glm::vec4(settings.baseColor, 1.0f);
        material.baseColorTexture = {};
        material.alphaMode = AlphaMode::Opaque;
    }
    if (isGiven("metallic")) material.metallic = settings.metallic;
    if (isGiven("roughness")) material.roughness = settings.roughness;
    if (isGiven("metallic") || isGiven("roughness")) material.metallicRoughnessTexture = {};
    if (isGiven("specular")) material.specular = settings.specular;
    if (isGiven("emission")) {
        material.emission = settings.emission;
        material.emissiveTexture = {};
    }
    if (isGiven("normal_scale")) material.normalScale = settings.normalScale;
    if (isGiven("double_sided")) material.doubleSided = settings.doubleSided;
}

Material makeMaterial(const std::string& name, const MaterialSettings& settings) {
    Material material;
    material.name = name;
    changeMaterial(material, {settings, fieldNames<MaterialSettings>()});
    return material;
}

}  // namespace voxray
