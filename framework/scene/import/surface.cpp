#include "scene/import/surface.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "scene/import/optics.h"

namespace voxray {
namespace {

/// Schlick's reflectance of KHR_materials_specular at normal incidence for an index of 1.5 and specularColor 1.
constexpr float kDefaultF0 = 0.04f;

TexturedColor roughnessOf(const TexturedColor& alpha) {
    return alpha.mapped(
        [](const glm::vec3& a) { return glm::vec3(std::sqrt(std::clamp((a.x + a.y + a.z) / 3, 0.0f, 1.0f))); });
}

/// Colors at most 1, for nothing reflects more than arrives.
TexturedColor atMostOne(const TexturedColor& color, const std::string& name, ImportNotes& notes) {
    TexturedColor limited = color;
    if (!color.image && glm::any(glm::greaterThan(color.value, glm::vec3(1))))
        notes.add("a reflectance above 1 is taken as 1", name);
    limited.value = glm::clamp(color.value, glm::vec3(0), color.image ? glm::vec3(1e30f) : glm::vec3(1));
    return limited;
}

TexturedColor blend(const TexturedColor& a, const TexturedColor& b, float weight) {
    if (!b.image) return a.mapped([&](const glm::vec3& c) { return glm::mix(c, b.value, weight); });
    if (!a.image) return b.mapped([&](const glm::vec3& c) { return glm::mix(a.value, c, weight); });
    // Two images: the pixels of the heavier one, the mean of the other
    const bool first = weight < 0.5f;
    const glm::vec3 mean = first ? b.mean() : a.mean();
    return (first ? a : b).mapped([&](const glm::vec3& c) { return glm::mix(c, mean, first ? weight : 1 - weight); });
}

/// Factor and texture of roughness and metallic: G and B.
void storeRoughness(const Surface& surface, Material& material, ColorImages& images) {
    if (!surface.roughness.image) {
        material.roughness = std::clamp(surface.roughness.value.y, 0.0f, 1.0f);
        return;
    }
    const TexturedColor packed = surface.roughness.mapped([](const glm::vec3& r) { return glm::vec3(1, r.y, 1); });
    glm::vec3 factor;
    material.metallicRoughnessTexture = images.store(packed, true, factor);
    material.roughness = std::clamp(factor.y, 0.0f, 1.0f);
}

}  // namespace

Surface lambertSurface(const TexturedColor& reflectance) {
    Surface surface;
    surface.color = reflectance;
    return surface;
}

Surface metalSurface(const TexturedColor& reflectance, const TexturedColor& alpha) {
    Surface surface;
    surface.color = reflectance;
    surface.metallic = 1;
    surface.specular = 1;
    surface.roughness = roughnessOf(alpha);
    return surface;
}

Surface coatedSurface(const TexturedColor& base, float eta, const TexturedColor& alpha, bool nonlinear) {
    Surface surface;
    surface.color = base;
    surface.specular = 1;
    surface.ior = std::max(eta, 1.0f);
    surface.roughness = roughnessOf(alpha);
    if (!nonlinear) return surface;
    const float internal = internalDiffuseReflectance(surface.ior);
    surface.color = base.mapped([&](const glm::vec3& r) {
        return glm::vec3(coatedReflectance(r.x, internal), coatedReflectance(r.y, internal),
                         coatedReflectance(r.z, internal));
    });
    return surface;
}

Surface glossySurface(const TexturedColor& base, const glm::vec3& reflectance, const TexturedColor& alpha) {
    // F0 = the reflectance and F90 = its largest channel; the base is lit by the rest and is brightened in turn
    const float most = std::clamp(std::max({reflectance.x, reflectance.y, reflectance.z}), 0.0f, 1.0f);
    if (most <= 0) return lambertSurface(base);
    Surface surface;
    surface.specular = most;
    surface.specularColor = reflectance / most / kDefaultF0;
    surface.roughness = roughnessOf(alpha);
    const float rest = std::max(1 - most, 1e-6f);
    surface.color = base.mapped([&](const glm::vec3& c) { return glm::min(c / rest, glm::vec3(1)); });
    return surface;
}

Surface paneSurface(const TexturedColor& transmittance) {
    Surface surface;
    surface.color = transmittance;
    surface.transmission = 1;
    surface.specular = 1;
    surface.roughness = glm::vec3(0);
    return surface;
}

Surface noSurface() {
    Surface surface;
    surface.isNothing = true;
    return surface;
}

Surface mixedSurface(const Surface& a, const Surface& b, float weight) {
    if (a.isNothing || b.isNothing) return a.isNothing ? b : a;
    Surface mixed;
    mixed.color = blend(a.color, b.color, weight);
    mixed.metallic = glm::mix(a.metallic, b.metallic, weight);
    mixed.roughness = blend(a.roughness, b.roughness, weight);
    mixed.specular = glm::mix(a.specular, b.specular, weight);
    mixed.specularColor = glm::mix(a.specularColor, b.specularColor, weight);
    mixed.ior = glm::mix(a.ior, b.ior, weight);
    mixed.transmission = glm::mix(a.transmission, b.transmission, weight);
    mixed.opacity = blend(a.opacity, b.opacity, weight);
    mixed.usesVertexColors = a.usesVertexColors || b.usesVertexColors;
    mixed.normalMap = weight < 0.5f ? a.normalMap : b.normalMap;
    return mixed;
}

float isotropicAlpha(float alphaU, float alphaV) {
    return std::sqrt(std::max(alphaU, 0.0f) * std::max(alphaV, 0.0f));
}

float alphaOfExponent(float exponent) {
    return std::sqrt(2 / (std::max(exponent, 0.0f) + 2));
}

uint32_t storeSurface(const Surface& surface, const SurfaceEmission& emission, const std::string& name, Scene& scene,
                      ColorImages& images, ImportNotes& notes) {
    Material material;
    material.name = name;
    material.metallic = std::clamp(surface.metallic, 0.0f, 1.0f);
    material.specular = std::clamp(surface.specular, 0.0f, 1.0f);
    material.specularColor = glm::clamp(surface.specularColor, glm::vec3(0), glm::vec3(1e30f));
    material.ior = std::clamp(surface.ior, 1.0f, 1000.0f);
    material.transmission = surface.transmission;
    storeRoughness(surface, material, images);

    glm::vec3 factor;
    const TexturedColor color = atMostOne(surface.color, name, notes);
    if (surface.opacity.image || surface.opacity.value != glm::vec3(1)) {
        material.alphaMode = AlphaMode::Mask;
        if (surface.opacity.image || (surface.opacity.value.x > 0 && surface.opacity.value.x < 1))
            notes.add("an opacity below 0.5 is a hole, another one none", name);
    }
    material.baseColorTexture = images.store(color, surface.opacity, factor);
    material.baseColor = glm::vec4(glm::clamp(factor, glm::vec3(0), glm::vec3(1)),
                                   surface.opacity.image ? 1.0f : std::clamp(surface.opacity.value.x, 0.0f, 1.0f));
    if (color.image && glm::any(glm::greaterThan(factor, glm::vec3(1))))
        notes.add("a reflectance above 1 is taken as 1", name);

    if (surface.normalMap) {
        TexturedColor normals;
        normals.image = surface.normalMap;
        material.normalTexture = images.store(normals, true, factor);
    }
    material.emissiveTexture = images.store(emission.radiance, false, factor);
    material.emission = glm::clamp(factor, glm::vec3(0), glm::vec3(1e30f));
    material.doubleSided = emission.twoSided;
    scene.materials.push_back(std::move(material));
    return uint32_t(scene.materials.size() - 1);
}

}  // namespace voxray
