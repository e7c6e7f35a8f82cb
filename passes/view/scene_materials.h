#pragma once

#include "scene/geometry.h"
#include "shaders/scene/texture_kinds.h"

namespace voxray {

/// What the camera may see of a scene's materials.
struct SceneMaterials {
    uint32_t textureKinds = 0;    ///< Bits of texture_kinds.h.
    double texturedFraction = 0;  ///< Of the triangles' area, 0 to 1.
    bool areLambert = true;       ///< None has a specular lobe.
    bool isDark = true;           ///< None emits light, and there is no environment.
};

/// Bits of texture_kinds.h.
inline uint32_t textureKinds(const Material& m) {
    uint32_t kinds = 0;
    if (m.baseColorTexture.texture >= 0) kinds |= BASE_COLOR_TEXTURES;
    if (m.metallicRoughnessTexture.texture >= 0) kinds |= METALLIC_ROUGHNESS_TEXTURES;
    if (m.normalTexture.texture >= 0) kinds |= NORMAL_TEXTURES;
    if (m.emissiveTexture.texture >= 0) kinds |= EMISSIVE_TEXTURES;
    return kinds;
}

inline SceneMaterials sceneMaterials(const SceneState& state) {
    SceneMaterials found;
    const Environment& environment = state.scene->environment;
    found.isDark = !environment.map && environment.radiance == glm::vec3(0);
    for (const Material& m : state.scene->materials) {
        found.textureKinds |= textureKinds(m);
        found.areLambert = found.areLambert && m.metallic == 0 && m.specular == 0;
        found.isDark = found.isDark && m.emission == glm::vec3(0);
    }

    double all = 0, textured = 0;
    for (uint32_t t = 0; t < state.geometry.triangleMaterials.size(); ++t) {
        const double area = triangleArea(state.geometry, t);
        all += area;
        if (textureKinds(state.scene->materials[state.geometry.triangleMaterials[t]]) != 0) textured += area;
    }
    if (all > 0) found.texturedFraction = textured / all;
    return found;
}

}  // namespace voxray
