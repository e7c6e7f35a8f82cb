#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

/// Reflectances of smooth interfaces, by Fresnel's equations for unpolarized light.
namespace voxray {

/// At normal incidence from a medium of index `outside` on a conductor of index eta + i k.
glm::vec3 conductorReflectance(const glm::vec3& eta, const glm::vec3& k, float outside = 1.0f);

/// At normal incidence on a dielectric of this relative index.
float dielectricReflectance(float eta);

/// Share of diffuse light below a dielectric of relative index eta > 1 that is reflected back into it:
/// 1 - (1 - F) / eta², with F the mean reflectance of diffuse light from outside.
float internalDiffuseReflectance(float eta);

/// Reflectance of a Lambert base of reflectance r under a smooth dielectric without the light that is reflected on
/// the outside, all reflections between both included: r (1 - f) / (1 - r f), f = internalDiffuseReflectance().
float coatedReflectance(float base, float internalReflectance);

/// Index of refraction by name as Mitsuba has it: "bk7", "water". nullopt: unknown.
std::optional<float> indexOfRefraction(const std::string& name);

/// Complex index of refraction of a metal by chemical symbol: means over red, green and blue of measured values
/// (Palik 1985 and others, as in the files of both renderers).
struct MetalIndex {
    glm::vec3 eta, k;
};
/// @param name "Cu", "metal-Cu-eta", "Cu_palik". nullopt: unknown.
std::optional<MetalIndex> metalIndex(const std::string& name);

}  // namespace voxray
