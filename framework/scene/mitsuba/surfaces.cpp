#include "scene/mitsuba/surfaces.h"

#include <algorithm>
#include <cmath>

#include "base/lower_case.h"
#include "scene/import/numbers.h"
#include "scene/import/optics.h"

namespace voxray::mitsuba {
namespace {

/// Mitsuba's defaults.
constexpr const char* kGlass = "bk7";
constexpr const char* kPlastic = "polypropylene";
constexpr float kAlpha = 0.1f;

}  // namespace

void Surfaces::approximated(const Plugin& bsdf, const std::string& as) {
    notes_.add(fmt::format("'{}' materials {}", bsdf.type, as), bsdf.name());
}

const Surface& Surfaces::surface(const Plugin& bsdf) {
    if (const auto entry = known_.find(&bsdf); entry != known_.end()) return entry->second;
    Surface made = make(bsdf);
    made.usesVertexColors = colors_.takeUsesVertexColors() || made.usesVertexColors;
    const std::vector<const Plugin*> inner = bsdf.childrenOf("bsdf");
    const bool isOpen = made.isNothing || made.transmission > 0;
    made.isOneSided = inner.empty()
                          ? !isOpen
                          : bsdf.type != "twosided" &&
                                std::ranges::any_of(inner, [&](const Plugin* of) { return surface(*of).isOneSided; });
    return known_.emplace(&bsdf, std::move(made)).first->second;
}

Surface Surfaces::make(const Plugin& bsdf) {
    const std::string& type = bsdf.type;
    const auto reflectance = [&](const char* name) {
        return colors_.color(bsdf, name, glm::vec3(0.5f), Meaning::Reflectance);
    };
    if (type == "diffuse") return lambertSurface(reflectance("reflectance"));
    if (type == "roughdiffuse") {
        approximated(bsdf, "become Lambert of the same reflectance");
        return lambertSurface(reflectance("reflectance"));
    }
    if (type == "twosided") return nested(bsdf);
    if (type == "conductor" || type == "roughconductor") return conductor(bsdf);
    if (type == "plastic" || type == "roughplastic") return plastic(bsdf);
    if (type == "dielectric" || type == "roughdielectric" || type == "thindielectric") return dielectric(bsdf);
    if (type == "phong" || type == "ward") return phongOrWard(bsdf);
    if (type == "principled" || type == "principledthin") return principled(bsdf);
    if (type == "blendbsdf") return blend(bsdf);
    if (type == "mixturebsdf") return mixture(bsdf);
    if (type == "mask") return mask(bsdf);
    if (type == "normalmap") return normalMap(bsdf);
    if (type == "null") return noSurface();
    if (type == "coating" || type == "roughcoating") return coating(bsdf);
    if (type == "bumpmap") {
        approximated(bsdf, "lose their bumps");
        return nested(bsdf);
    }
    if (type == "difftrans") {
        approximated(bsdf, "become panes of their transmittance");
        return paneSurface(reflectance("transmittance"));
    }
    approximated(bsdf, "are not known and become Lambert of reflectance 0.5");
    return lambertSurface(glm::vec3(0.5f));
}

Surface Surfaces::nested(const Plugin& bsdf) {
    const std::vector<const Plugin*> inner = bsdf.childrenOf("bsdf");
    if (inner.empty()) throw Error(bsdf.where, "{} has no BSDF in it", bsdf.what());
    if (inner.size() > 1 && bsdf.type == "twosided") approximated(bsdf, "of two BSDFs have the first on both sides");
    return surface(*inner.front());
}

float Surfaces::index(const Plugin& bsdf, const std::string& name, const std::string& fallback) {
    const Property* given = bsdf.find(name);
    if (given && given->tag != "string") return std::max(colors_.number(bsdf, name, 1), 1e-3f);
    const std::string material = bsdf.text(name, fallback);
    if (const auto known = indexOfRefraction(material)) return *known;
    throw Error(bsdf.where, "{}: no index of refraction is known for '{}': give a number", name, oneLine(material, 60));
}

float Surfaces::relativeIndex(const Plugin& bsdf, const std::string& inside) {
    return index(bsdf, "int_ior", inside) / index(bsdf, "ext_ior", "air");
}

TexturedColor Surfaces::alpha(const Plugin& bsdf) {
    if (const std::string distribution = lowerCase(bsdf.text("distribution", "beckmann")); distribution != "ggx")
        notes_.add(fmt::format("microfacets of '{}' become GGX of the same alpha", distribution), bsdf.name());
    if (bsdf.find("alpha_u") || bsdf.find("alpha_v") || bsdf.child("alpha_u") || bsdf.child("alpha_v")) {
        approximated(bsdf, "become isotropic: alpha is the root of alpha_u times alpha_v");
        return glm::vec3(
            isotropicAlpha(colors_.number(bsdf, "alpha_u", kAlpha), colors_.number(bsdf, "alpha_v", kAlpha)));
    }
    return colors_.color(bsdf, "alpha", glm::vec3(kAlpha), Meaning::Quantity);
}

Surface Surfaces::conductor(const Plugin& bsdf) {
    const std::string material = bsdf.text("material", bsdf.find("eta") || bsdf.child("eta") ? "" : "Cu");
    glm::vec3 reflectance(1);
    if (lowerCase(material) != "none") {
        MetalIndex metal{glm::vec3(0), glm::vec3(1)};
        if (const auto known = metalIndex(material)) {
            metal = *known;
        } else if (!material.empty()) {
            throw Error(bsdf.where, "material: no metal '{}' is known: give eta and k", oneLine(material, 60));
        }
        metal.eta = colors_.plain(bsdf, "eta", metal.eta, Meaning::Quantity);
        metal.k = colors_.plain(bsdf, "k", metal.k, Meaning::Quantity);
        reflectance = conductorReflectance(metal.eta, metal.k, index(bsdf, "ext_eta", "air"));
    }
    TexturedColor color = colors_.color(bsdf, "specular_reflectance", glm::vec3(1), Meaning::Reflectance);
    color.value *= reflectance;
    return metalSurface(color, bsdf.type == "conductor" ? TexturedColor(glm::vec3(0)) : alpha(bsdf));
}

Surface Surfaces::plastic(const Plugin& bsdf) {
    approximated(bsdf, "become a Lambert base below a dielectric lobe by Schlick's formula");
    const TexturedColor base = colors_.color(bsdf, "diffuse_reflectance", glm::vec3(0.5f), Meaning::Reflectance);
    Surface surface = coatedSurface(base, relativeIndex(bsdf, kPlastic),
                                    bsdf.type == "plastic" ? TexturedColor(glm::vec3(0)) : alpha(bsdf),
                                    bsdf.flag("nonlinear", false));
    const glm::vec3 specular = colors_.plain(bsdf, "specular_reflectance", glm::vec3(1), Meaning::Reflectance);
    surface.specularColor *= specular;
    return surface;
}

Surface Surfaces::coating(const Plugin& bsdf) {
    const Surface base = nested(bsdf);
    if (base.metallic > 0 || base.specular > 0 || base.transmission > 0) {
        approximated(bsdf, "over other than Lambert materials are lost");
        return base;
    }
    approximated(bsdf, "become a dielectric lobe by Schlick's formula over a Lambert base");
    Surface coated = coatedSurface(base.color, relativeIndex(bsdf, kGlass),
                                   bsdf.type == "coating" ? TexturedColor(glm::vec3(0)) : alpha(bsdf), true);
    coated.opacity = base.opacity;
    coated.normalMap = base.normalMap;
    coated.usesVertexColors = base.usesVertexColors;
    return coated;
}

Surface Surfaces::dielectric(const Plugin& bsdf) {
    approximated(bsdf, "become panes: light passes them straight, without refraction, reflection and roughness");
    const float reflectance = dielectricReflectance(relativeIndex(bsdf, kGlass));
    TexturedColor transmittance = colors_.color(bsdf, "specular_transmittance", glm::vec3(1), Meaning::Reflectance);
    // A thin one has two interfaces, between which light is reflected
    transmittance.value *= bsdf.type == "thindielectric" ? (1 - reflectance) / (1 + reflectance) : 1 - reflectance;
    return paneSurface(transmittance);
}

Surface Surfaces::phongOrWard(const Plugin& bsdf) {
    approximated(bsdf, "become a Lambert base below a GGX lobe of equal width");
    const TexturedColor base = colors_.color(bsdf, "diffuse_reflectance", glm::vec3(0.5f), Meaning::Reflectance);
    const glm::vec3 specular = colors_.plain(bsdf, "specular_reflectance", glm::vec3(0.2f), Meaning::Reflectance);
    const float width = bsdf.type == "phong" ? alphaOfExponent(colors_.number(bsdf, "exponent", 30))
                                             : isotropicAlpha(colors_.number(bsdf, "alpha_u", kAlpha),
                                                              colors_.number(bsdf, "alpha_v", kAlpha));
    return glossySurface(base, specular, glm::vec3(width));
}

Surface Surfaces::principled(const Plugin& bsdf) {
    for (const char* ignored :
         {"anisotropic", "sheen", "sheen_tint", "clearcoat", "clearcoat_gloss", "flatness", "spec_tint", "diff_trans"})
        if (bsdf.child(ignored) || bsdf.number(ignored, 0) != 0)
            approximated(bsdf, fmt::format("lose their '{}'", ignored));
    approximated(bsdf, "become metallic-roughness ones with a Lambert base");
    Surface surface;
    surface.color = colors_.color(bsdf, "base_color", glm::vec3(0.5f), Meaning::Reflectance);
    const float transmission = colors_.number(bsdf, "spec_trans", 0);
    if (transmission >= 0.5f) {
        approximated(bsdf, "of 'spec_trans' from 0.5 on become panes");
        return paneSurface(surface.color);
    }
    surface.metallic = colors_.number(bsdf, "metallic", 0);
    surface.roughness = colors_.color(bsdf, "roughness", glm::vec3(0.5f), Meaning::Quantity);
    surface.specular = 1;
    // Mitsuba's relation between the two
    const float root = std::sqrt(std::clamp(0.08f * colors_.number(bsdf, "specular", 0.5f), 0.0f, 0.99f));
    surface.ior = std::max(colors_.number(bsdf, "eta", 2 / (1 - root) - 1), 1.0f);
    return surface;
}

Surface Surfaces::blend(const Plugin& bsdf) {
    const std::vector<const Plugin*> inner = bsdf.childrenOf("bsdf");
    if (inner.size() != 2) throw Error(bsdf.where, "{} has {} BSDFs in it, not two", bsdf.what(), inner.size());
    approximated(bsdf, "become one material of mixed parameters");
    const float weight = std::clamp(colors_.number(bsdf, "weight", 0.5f), 0.0f, 1.0f);
    return mixedSurface(surface(*inner[0]), surface(*inner[1]), weight);
}

Surface Surfaces::mixture(const Plugin& bsdf) {
    const std::vector<const Plugin*> inner = bsdf.childrenOf("bsdf");
    const std::vector<double> weights = readNumbers(bsdf.text("weights", ""));
    if (inner.empty() || inner.size() != weights.size())
        throw Error(bsdf.where, "{} has {} BSDFs in it and {} weights", bsdf.what(), inner.size(), weights.size());
    approximated(bsdf, "become one material of mixed parameters");
    Surface mixed = surface(*inner[0]);
    double sum = std::max(weights[0], 0.0);
    for (size_t i = 1; i < inner.size(); ++i) {
        sum += std::max(weights[i], 0.0);
        const double share = sum > 0 ? std::max(weights[i], 0.0) / sum : 0.0;
        mixed = mixedSurface(mixed, surface(*inner[i]), float(share));
    }
    if (sum < 0.999) mixed.color.value *= float(sum);  // The rest is black
    return mixed;
}

Surface Surfaces::mask(const Plugin& bsdf) {
    Surface surface = nested(bsdf);
    surface.opacity = colors_.color(bsdf, "opacity", glm::vec3(0.5f), Meaning::Quantity);
    return surface;
}

Surface Surfaces::normalMap(const Plugin& bsdf) {
    Surface surface = nested(bsdf);
    const TexturedColor map = colors_.color(bsdf, "normalmap", glm::vec3(0.5f, 0.5f, 1), Meaning::Quantity);
    surface.normalMap = map.image;
    return surface;
}

}  // namespace voxray::mitsuba
