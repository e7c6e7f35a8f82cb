#pragma once

#include <string>

#include "scene/import/textured_color.h"

/// The one place where materials of other renderers become metallic-roughness ones.
namespace voxray {

/// A material before it is stored in a scene. Both readers make theirs by the functions below.
struct Surface {
    TexturedColor color{glm::vec3(0.5f)};
    float metallic = 0;
    TexturedColor roughness{glm::vec3(1.0f)};  ///< Perceptual, channels equal: its square is GGX's alpha.
    float specular = 0;
    glm::vec3 specularColor{1.0f};
    float ior = 1.5f;
    float transmission = 0;
    TexturedColor opacity{glm::vec3(1.0f)};
    std::shared_ptr<const ColorImage> normalMap;  ///< Of the tangent space, 0 to 1; nullptr: none.
    bool usesVertexColors = false;                ///< The color is that of the mesh times `color`.
    bool isOneSided = false;                      ///< In its file it reflects on its front alone.
    bool isNothing = false;                       ///< No surface: a border of media.
};

/// a/π.
Surface lambertSurface(const TexturedColor& reflectance);
/// A conductor of this reflectance at normal incidence. @param alpha of GGX, 0: a mirror
Surface metalSurface(const TexturedColor& reflectance, const TexturedColor& alpha);
/// A Lambert base below a dielectric of relative index eta. @param nonlinear light that the dielectric reflects back
/// is coloured by the base each time, see coatedReflectance(); otherwise the base is as bright as without it
Surface coatedSurface(const TexturedColor& base, float eta, const TexturedColor& alpha, bool nonlinear);
/// A Lambert base, and a lobe of constant reflectance over it: Phong's and Ward's models. The base keeps its share.
Surface glossySurface(const TexturedColor& base, const glm::vec3& reflectance, const TexturedColor& alpha);
/// A pane (panes.h) of this transmittance.
Surface paneSurface(const TexturedColor& transmittance);
/// No surface at all.
Surface noSurface();
/// Parameters mixed linearly. @param weight of the second, 0 to 1
Surface mixedSurface(const Surface& first, const Surface& second, float weight);

/// GGX's alpha of two, along both tangents: their geometric mean.
float isotropicAlpha(float alphaU, float alphaV);
/// GGX's alpha of a Phong lobe of this exponent, of equal variance of slopes: √(2 / (n + 2)) (Walter et al. 2007).
float alphaOfExponent(float exponent);

/// What shines from a surface, W/(m² sr).
struct SurfaceEmission {
    TexturedColor radiance{glm::vec3(0.0f)};
    bool twoSided = false;
};

/// Stores a surface as a material of the scene. @return its number
uint32_t storeSurface(const Surface& surface, const SurfaceEmission& emission, const std::string& name, Scene& scene,
                      ColorImages& images, ImportNotes& notes);

}  // namespace voxray
