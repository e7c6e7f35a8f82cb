#pragma once

#include <filesystem>
#include <glm/vec3.hpp>

#include "scene/pbrt/parameters.h"

/// Spectra of pbrt as linear Rec.709: values in the file, of the types rgb, float, blackbody and spectrum, which is a
/// list of wavelengths and values, a file of it or a name.
namespace voxray::pbrt {

/// Of light: rgb as it is; a spectrum or black body gives the color alone, of luminance 1, as in pbrt.
glm::vec3 emissionOf(const Parameter& parameter, const std::filesystem::path& folder);

/// Of a reflectance, lit by D65.
glm::vec3 reflectanceOf(const Parameter& parameter, const std::filesystem::path& folder);

/// Index of refraction of a dielectric at about 589 nm, or the mean of its spectrum.
float indexOf(const Parameter& parameter, const std::filesystem::path& folder);

/// Reflectance of a conductor at normal incidence, lit by D65. @param eta, k nullptr: copper's, as in pbrt
/// @param outside index of the medium above it
glm::vec3 conductorOf(const Parameter* eta, const Parameter* k, float outside, const std::filesystem::path& folder);

}  // namespace voxray::pbrt
