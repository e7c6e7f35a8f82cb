#include "scene/pbrt/materials.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "base/suggest.h"
#include "scene/import/optics.h"
#include "scene/pbrt/spectra.h"

namespace voxray::pbrt {
namespace {

constexpr float kDefaultIndex = 1.5f;

const std::vector<std::string> kKinds{"coatedconductor",     "coateddiffuse", "conductor", "dielectric", "diffuse",
                                      "diffusetransmission", "hair",          "interface", "measured",   "mix",
                                      "subsurface",          "thindielectric"};

/// Of a pane of two interfaces with all reflections between them.
float thinTransmittance(float eta) {
    const float once = dielectricReflectance(eta);
    return (1 - once) / (1 + once);
}

}  // namespace

std::string Materials::nameOf(const MaterialUse& use) {
    if (!use.material) return use.name;
    return use.material->where.file.empty() ? use.material->kind : use.material->kind + " " + use.material->place();
}

const Parameters& Materials::parametersOf(const MaterialUse& use) const {
    if (use.material) return *use.material;
    const auto found = description_.materials.find(use.name);
    if (found != description_.materials.end()) return *found->second;
    std::vector<std::string> names;
    for (const auto& entry : description_.materials) names.push_back(entry.first);
    throw Error(use.where, "no MakeNamedMaterial defines \"{}\"{}", use.name.substr(0, 100),
                names.empty() ? "" : didYouMean(use.name, names).substr(0, 300));
}

Surface Materials::surface(const MaterialUse& use) {
    const Parameters& parameters = parametersOf(use);
    return made(parameters, use.material ? parameters.kind : parameters.text("type", ""), nameOf(use));
}

const Surface& Materials::made(const Parameters& material, const std::string& kind, const std::string& name) {
    const auto known = made_.find(&material);
    if (known != made_.end()) return known->second;
    constexpr size_t kMaxDepth = 50;
    if (depth_ >= kMaxDepth)
        material.fail("materials are mixed more than {} deep; does one contain itself?", kMaxDepth);
    ++depth_;
    Surface surface = make(material, kind, name);
    --depth_;
    if (material.find("displacement")) import_.notes().add("bump and displacement maps are left out", name);
    const std::string normals = material.text("normalmap", "");
    if (!normals.empty()) surface.normalMap = textures_.image(normals, ColorImages::Stored::Linear);
    return made_[&material] = std::move(surface);
}

Surface Materials::make(const Parameters& material, const std::string& kind, const std::string& name) {
    ImportNotes& notes = import_.notes();
    if (kind == "diffuse") return lambertSurface(textures_.color(material, "reflectance", glm::vec3(0.5f)));
    if (kind == "coateddiffuse") {
        notes.add("'coateddiffuse' materials are Lambert below one reflection; light in the coat is approximated",
                  name);
        material.ignore({"thickness", "g", "albedo", "maxdepth", "nsamples", "twosided"});
        return coatedSurface(textures_.color(material, "reflectance", glm::vec3(0.5f)), index(material, "eta"),
                             alpha(material, "", name), true);
    }
    if (kind == "conductor") return conductor(material, name);
    if (kind == "coatedconductor") return coatedConductor(material, name);
    if (kind == "dielectric" || kind == "thindielectric") return dielectric(material, name, kind == "thindielectric");
    if (kind == "mix") return mix(material, name);
    if (kind.empty() || kind == "interface" || kind == "none") return noSurface();
    if (kind == "diffusetransmission") {
        notes.add("'diffusetransmission' materials reflect as Lambert and transmit nothing", name);
        material.ignore({"transmittance"});
        const auto scale = float(material.number("scale", 1));
        TexturedColor reflectance = textures_.color(material, "reflectance", glm::vec3(0.25f));
        reflectance.value *= scale;
        return lambertSurface(reflectance);
    }
    if (kind == "subsurface") {
        notes.add("'subsurface' materials are Lambert below one reflection, of their 'reflectance' or grey", name);
        material.ignore({"mfp", "sigma_a", "sigma_s", "name", "scale", "g"});
        return coatedSurface(textures_.color(material, "reflectance", glm::vec3(0.5f)), index(material, "eta"),
                             alpha(material, "", name), true);
    }
    if (kind == "hair" || kind == "measured") {
        notes.add("'" + kind + "' materials are grey Lambert", name);
        return lambertSurface(glm::vec3(0.5f));
    }
    static const std::vector<std::string> old{"disney", "fourier", "glass",     "kdsubsurface", "matte", "metal",
                                              "mirror", "plastic", "substrate", "translucent",  "uber"};
    if (std::ranges::find(old, kind) != old.end())
        material.fail("the material \"{}\" is one of pbrt-v3; convert the scene by `pbrt --upgrade`", kind);
    material.fail("the material \"{}\" is unknown{}", kind.substr(0, 40), didYouMean(kind, kKinds));
}

float Materials::index(const Parameters& material, const std::string& parameter) {
    const Parameter* eta = material.find(parameter);
    if (!eta) return kDefaultIndex;
    if (eta->type == "spectrum") return indexOf(*eta, textures_.folder());
    return textures_.plainNumber(material, parameter, kDefaultIndex);
}

TexturedColor Materials::alpha(const Parameters& material, const std::string& prefix, const std::string& name) {
    const TexturedColor both = textures_.number(material, prefix + "roughness", 0);
    TexturedColor u =
        material.find(prefix + "uroughness") ? textures_.number(material, prefix + "uroughness", 0) : both;
    const TexturedColor v =
        material.find(prefix + "vroughness") ? textures_.number(material, prefix + "vroughness", 0) : both;
    const bool remaps = material.flag("remaproughness", true);
    if (!u.image && !v.image) {
        if (u.value != v.value) import_.notes().add("anisotropic roughness is the mean of both directions", name);
        u.value = glm::vec3(isotropicAlpha(u.value.x, v.value.x));
    } else if (u.image != v.image) {
        import_.notes().add("anisotropic roughness is that along u", name);
        if (!u.image) u = v;
    }
    // Pharr et al., pbrt-v4: alpha = √roughness
    return remaps ? u.mapped([](const glm::vec3& r) { return glm::sqrt(glm::max(r, glm::vec3(0))); }) : u;
}

Surface Materials::conductor(const Parameters& material, const std::string& name) {
    const TexturedColor rough = alpha(material, "", name);
    if (material.find("reflectance"))
        return metalSurface(textures_.color(material, "reflectance", glm::vec3(1)), rough);
    return metalSurface(conductorOf(material.find("eta"), material.find("k"), 1, textures_.folder()), rough);
}

Surface Materials::coatedConductor(const Parameters& material, const std::string& name) {
    import_.notes().add("'coatedconductor' materials are metals with the reflectance of coat and metal together", name);
    material.ignore({"thickness", "g", "albedo", "maxdepth", "nsamples"});
    const float eta = std::max(index(material, "interface.eta"), 1.0f), coat = dielectricReflectance(eta);
    TexturedColor base;
    if (material.find("reflectance"))
        base = textures_.color(material, "reflectance", glm::vec3(1));
    else
        base = conductorOf(material.find("conductor.eta"), material.find("conductor.k"), eta, textures_.folder());
    // All reflections between both interfaces
    const TexturedColor both = base.mapped([&](const glm::vec3& metal) {
        const glm::vec3 m = glm::clamp(metal, glm::vec3(0), glm::vec3(1));
        return coat + (1 - coat) * (1 - coat) * m / (1.0f - coat * m);
    });
    const TexturedColor outer = alpha(material, "interface.", name), inner = alpha(material, "conductor.", name);
    const float outerAlpha = outer.mean().x;
    return metalSurface(both, inner.mapped([&](const glm::vec3& a) {
        return glm::min(glm::sqrt(a * a + outerAlpha * outerAlpha), glm::vec3(1));
    }));
}

Surface Materials::dielectric(const Parameters& material, const std::string& name, bool isThin) {
    import_.notes().add("dielectric materials let light pass straight, dimmed by what they reflect: see panes", name);
    material.ignore({"roughness", "uroughness", "vroughness", "remaproughness"});
    const float eta = index(material, "eta");
    return paneSurface(glm::vec3(isThin ? thinTransmittance(eta) : 1 - dielectricReflectance(eta)));
}

Surface Materials::mix(const Parameters& material, const std::string& name) {
    const std::vector<std::string> names = material.texts("materials");
    if (names.size() != 2) material.fail("a mix has two 'materials', not {}", names.size());
    const float amount = std::clamp(textures_.plainNumber(material, "amount", 0.5f), 0.0f, 1.0f);
    import_.notes().add("'mix' materials are one whose parameters are mixed", name);
    const auto of = [&](const std::string& other) { return surface({nullptr, other, material.where}); };
    return mixedSurface(of(names[0]), of(names[1]), amount);
}

}  // namespace voxray::pbrt
