#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

/// Spectra that pbrt has by name.
namespace voxray::pbrt {

/// Reflectance at normal incidence from air under D65 of "metal-Ag-eta" and others: linear Rec.709, from eta and k of
/// each wavelength. Source: pbrt-v4's tables (Palik 1985; SOPRA), integrated by the color matching functions of
/// spectrum.h; MgO and TiO2 by the dispersion formulas of Stephens and Malitson 1952 and DeVore 1951.
/// @param name of eta or of k. nullopt: unknown
std::optional<glm::vec3> namedMetalReflectance(const std::string& name);

/// Index at 589 nm of "glass-BK7" and others. Where pbrt says F5, F10 and F11 its tables are those of Schott's SF5,
/// SF10 and SF11. nullopt: unknown
std::optional<float> namedGlassIndex(const std::string& name);

/// Chromaticity x, y of "stdillum-D65" and others. Source: CIE 15:2004; ACES for D60. nullopt: unknown
std::optional<glm::dvec2> namedIlluminant(const std::string& name);

}  // namespace voxray::pbrt
