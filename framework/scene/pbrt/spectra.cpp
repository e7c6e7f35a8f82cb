#include "scene/pbrt/spectra.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <variant>

#include "base/files.h"
#include "scene/import/optics.h"
#include "scene/import/spectrum.h"
#include "scene/pbrt/files.h"
#include "scene/pbrt/named_spectra.h"

namespace voxray::pbrt {
namespace {

constexpr size_t kMaxSpectrumBytes = 1 << 20;

/// A spectrum's own data: its name, its points, or a color.
using Spectrum = std::variant<std::string, SpectrumPoints, glm::vec3>;

glm::vec3 rgbOf(const Parameter& parameter) {
    const std::vector<double>& n = parameter.numbers;
    if (n.size() != 3)
        throw Error(parameter.where, "parameter '{}' has {} numbers; it wants 3", parameter.name, n.size());
    const glm::dvec3 rgb(n[0], n[1], n[2]);
    if (std::min({rgb.x, rgb.y, rgb.z}) < 0)
        throw Error(parameter.where, "parameter '{}' has a color below 0", parameter.name);
    return glm::vec3(glm::max(rec709Of(parameter.colorSpace).value_or(glm::dmat3(1)) * rgb, glm::dvec3(0)));
}

SpectrumPoints pointsOf(const Parameter& parameter) {
    SpectrumPoints points;
    for (size_t i = 0; i + 1 < parameter.numbers.size(); i += 2) {
        if (!points.empty() && !(parameter.numbers[i] > points.back().first))
            throw Error(parameter.where, "the wavelengths of '{}' don't increase", parameter.name);
        points.emplace_back(parameter.numbers[i], parameter.numbers[i + 1]);
    }
    return points;
}

bool isNamed(const std::string& name) {
    return namedMetalReflectance(name) || namedGlassIndex(name) || namedIlluminant(name);
}

Spectrum spectrumOf(const Parameter& parameter, const std::filesystem::path& folder) {
    if (parameter.type == "rgb") return rgbOf(parameter);
    if (parameter.type == "float" && parameter.numbers.size() == 1) return glm::vec3(float(parameter.numbers[0]));
    if (parameter.type != "spectrum")
        throw Error(parameter.where, "parameter '{}' is of type {}; it wants rgb or spectrum", parameter.name,
                    parameter.type);
    if (!parameter.numbers.empty()) return pointsOf(parameter);
    if (parameter.strings.size() != 1) throw Error(parameter.where, "parameter '{}' has no values", parameter.name);
    const std::string& name = parameter.strings[0];
    if (isNamed(name)) return name;
    std::error_code code;
    if (!std::filesystem::is_regular_file(folder / name, code))
        throw Error(parameter.where, "'{}' is neither a spectrum that pbrt has by name nor a file",
                    name.substr(0, 100));
    if (std::filesystem::file_size(folder / name, code) > kMaxSpectrumBytes)
        throw Error(parameter.where, "{} is too large for a spectrum", name.substr(0, 100));
    try {
        return readSpectrumPoints(readTextFile(folder / name));
    } catch (const Error& error) {
        throw Error(parameter.where, "{}: {}", name.substr(0, 100), error.what());
    }
}

/// The color of a spectrum whose luminance is 1; black for a black one.
glm::vec3 unitColor(const glm::dvec3& xyz) {
    return xyz.y > 0 && std::isfinite(xyz.x + xyz.y + xyz.z) ? rgbOfXyz(xyz / xyz.y) : glm::vec3(0);
}

double valueOf(const SpectrumPoints& points, double nm) {
    const auto next = std::ranges::upper_bound(points, nm, {}, &SpectrumPoints::value_type::first);
    if (next == points.begin()) return points.front().second;
    if (next == points.end()) return points.back().second;
    const auto& [x1, y1] = *next;
    const auto& [x0, y0] = *(next - 1);
    return y0 + (y1 - y0) * (nm - x0) / (x1 - x0);
}

/// Fresnel's reflectance wavelength by wavelength.
glm::vec3 reflectanceOf(const SpectrumPoints& eta, const SpectrumPoints& k, double outside) {
    SpectrumPoints reflectance;
    for (double nm = 380; nm <= 780; nm += 5) {
        const double n = valueOf(eta, nm) / outside, e = valueOf(k, nm) / outside;
        const double r = ((n - 1) * (n - 1) + e * e) / ((n + 1) * (n + 1) + e * e);
        reflectance.emplace_back(nm, r);
    }
    return glm::min(rgbOfReflectance(reflectance), glm::vec3(1));
}

/// Means of eta or k over red, green and blue.
glm::vec3 quantityOf(const Spectrum& spectrum, bool isEta, const Parameter& parameter) {
    if (const auto* rgb = std::get_if<glm::vec3>(&spectrum)) return *rgb;
    if (const auto* points = std::get_if<SpectrumPoints>(&spectrum)) return rgbOfQuantity(*points);
    const std::string& name = std::get<std::string>(spectrum);
    if (const auto metal = metalIndex(name)) return isEta ? metal->eta : metal->k;
    if (const auto glass = namedGlassIndex(name)) return glm::vec3(*glass);
    if (const auto reflectance = namedMetalReflectance(name)) {
        // No metal: eta by F = ((eta - 1) / (eta + 1))², k = 0
        const glm::vec3 root = glm::sqrt(*reflectance);
        return isEta ? (1.0f + root) / (1.0f - root) : glm::vec3(0);
    }
    throw Error(parameter.where, "'{}' is no index of refraction", name);
}

std::string metalName(const Spectrum& spectrum) {
    const auto* name = std::get_if<std::string>(&spectrum);
    return name && namedMetalReflectance(*name) ? name->substr(0, name->find_last_of('-')) : "";
}

}  // namespace

glm::vec3 emissionOf(const Parameter& parameter, const std::filesystem::path& folder) {
    if (parameter.type == "blackbody") {
        const double kelvin = parameter.numbers.empty() ? 0 : parameter.numbers[0];
        if (parameter.numbers.size() == 2)
            throw Error(parameter.where,
                        "a blackbody has one number, its temperature; convert a scene of pbrt-v3 by "
                        "`pbrt --upgrade`");
        if (!(kelvin > 0)) throw Error(parameter.where, "a blackbody's temperature is above 0 K, not {}", kelvin);
        return unitColor(xyzOfBlackbody(kelvin));
    }
    const Spectrum spectrum = spectrumOf(parameter, folder);
    if (const auto* rgb = std::get_if<glm::vec3>(&spectrum)) return *rgb;
    if (const auto* points = std::get_if<SpectrumPoints>(&spectrum)) return unitColor(xyzOfEmission(*points));
    const auto xy = namedIlluminant(std::get<std::string>(spectrum));
    if (!xy) throw Error(parameter.where, "'{}' is no light's spectrum", std::get<std::string>(spectrum));
    return unitColor({xy->x / xy->y, 1, (1 - xy->x - xy->y) / xy->y});
}

glm::vec3 reflectanceOf(const Parameter& parameter, const std::filesystem::path& folder) {
    const Spectrum spectrum = spectrumOf(parameter, folder);
    if (const auto* rgb = std::get_if<glm::vec3>(&spectrum)) return *rgb;
    if (const auto* points = std::get_if<SpectrumPoints>(&spectrum)) return rgbOfReflectance(*points);
    throw Error(parameter.where, "'{}' is no reflectance", std::get<std::string>(spectrum));
}

float indexOf(const Parameter& parameter, const std::filesystem::path& folder) {
    const glm::vec3 index = quantityOf(spectrumOf(parameter, folder), true, parameter);
    return (index.x + index.y + index.z) / 3;
}

glm::vec3 conductorOf(const Parameter* eta, const Parameter* k, float outside, const std::filesystem::path& folder) {
    Parameter copper;
    copper.type = "spectrum";
    copper.strings = {"metal-Cu-eta"};
    const Parameter &etaUsed = eta ? *eta : copper, &kUsed = k ? *k : copper;
    const Spectrum etaSpectrum = spectrumOf(etaUsed, folder), kSpectrum = spectrumOf(kUsed, folder);
    const std::string metal = metalName(etaSpectrum);
    if (outside == 1 && !metal.empty() && metal == metalName(kSpectrum)) return *namedMetalReflectance(metal + "-eta");
    const auto* etaPoints = std::get_if<SpectrumPoints>(&etaSpectrum);
    const auto* kPoints = std::get_if<SpectrumPoints>(&kSpectrum);
    if (etaPoints && kPoints && !etaPoints->empty() && !kPoints->empty())
        return reflectanceOf(*etaPoints, *kPoints, double(outside));
    return conductorReflectance(quantityOf(etaSpectrum, true, etaUsed), quantityOf(kSpectrum, false, kUsed), outside);
}

}  // namespace voxray::pbrt
