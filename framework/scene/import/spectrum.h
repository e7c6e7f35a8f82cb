#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Spectra as linear Rec.709. Source of the tables: CIE 1931 standard observer and D65, every 10 nm.
namespace voxray {

/// A spectrum by points (wavelength in nm, value), linear between them and 0 outside.
using SpectrumPoints = std::vector<std::pair<double, double>>;

/// Text of pairs: "400 0.1 500 0.3" or "400:0.1, 500:0.3"; lines that begin with # are comments.
/// @throws Error for what is no pair of numbers, or wavelengths that don't increase
SpectrumPoints readSpectrumPoints(const std::string& text);

/// XYZ of emitted light, ∫ v(λ) x̄(λ) dλ / ∫ ȳ(λ) dλ: a constant spectrum of 1 has Y = 1.
glm::dvec3 xyzOfEmission(const SpectrumPoints& spectrum);

/// Linear Rec.709 of XYZ, which is (1, 1, 1) for D65 of Y = 1. Negative channels are 0.
glm::vec3 rgbOfXyz(const glm::dvec3& xyz);

/// Color of a reflectance, lit by D65: a constant of 1 is (1, 1, 1).
glm::vec3 rgbOfReflectance(const SpectrumPoints& spectrum);

/// Means of a quantity, such as an index of refraction, over the red, green and blue of the eye; not negative.
glm::vec3 rgbOfQuantity(const SpectrumPoints& spectrum);

/// XYZ of a black body, W/(m² sr nm) as emission. Source: Planck's law. @param kelvin above 0
glm::dvec3 xyzOfBlackbody(double kelvin);

/// "#rrggbb" as linear color; nullopt: something else.
std::optional<glm::vec3> rgbOfHex(const std::string& text);

/// Matrix to linear Rec.709 from the primaries of a color space of pbrt: "srgb", "dci-p3", "rec2020" or
/// "aces2065-1". nullopt: another name.
std::optional<glm::dmat3> rec709Of(const std::string& colorSpace);

}  // namespace voxray
