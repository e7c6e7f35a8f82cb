#pragma once

#include <glm/vec3.hpp>

#include "passes/path_trace/sampling.h"

/// glTF 2.0 metallic-roughness, appendix B, with KHR_materials_specular and KHR_materials_ior.
namespace voxray::path_trace {

/// Below this alpha (roughness²) a surface is a perfect mirror: a delta lobe.
constexpr float kMirrorAlpha = 1e-3f;

/// The BSDF times cosine, and the density of sampling the direction, per steradian.
struct BsdfValue {
    glm::vec3 fCos{0.0f};
    float pdf = 0.0f;
};

struct BsdfSample {
    glm::vec3 direction{0.0f};
    glm::vec3 weight{0.0f};  ///< f cos / pdf; 0 for a direction below the surface or along it.
    float pdf = 0.0f;        ///< Per steradian; 0 for a mirror.
    bool isMirror = false;
};

/// Reflection at a point: a Lambert lobe under a GGX lobe, combined by Schlick's Fresnel term. All vectors
/// are unit length and point away from the surface; `n` is the shading normal.
struct Bsdf {
    glm::vec3 diffuse{0.0f};    ///< Base color * (1 - metallic).
    float alpha = 1.0f;         ///< Roughness squared.
    glm::vec3 f0{0.0f};         ///< Specular reflectance at normal incidence, metal and dielectric mixed.
    float f90 = 0.0f;           ///< The same at grazing incidence.
    float dielectricF0 = 0.0f;  ///< Maximum component of the dielectric layer's f0, which attenuates diffuse light.
    float dielectricF90 = 0.0f;

    /// From a material's parameters, with textures multiplied in. `specular` and `specularColor` are those of
    /// KHR_materials_specular.
    static Bsdf make(const glm::vec3& baseColor, float metallic, float roughness, float specular,
                     const glm::vec3& specularColor, float ior) {
        const glm::vec3 dielectric =
            glm::min(specularColor * square((ior - 1.0f) / (ior + 1.0f)), glm::vec3(1.0f)) * specular;
        Bsdf b;
        b.diffuse = baseColor * (1.0f - metallic);
        b.alpha = roughness * roughness;
        b.f0 = glm::mix(dielectric, baseColor, metallic);
        b.f90 = glm::mix(specular, 1.0f, metallic);
        b.dielectricF0 = maxComponent(dielectric);
        b.dielectricF90 = specular;
        return b;
    }

    bool hasSpecular() const { return f90 > 0.0f; }
    bool isMirror() const { return alpha < kMirrorAlpha; }

    /// Probability that sample() takes the specular lobe.
    float specularProbability(float cosOut) const {
        if (!hasSpecular()) return 0.0f;
        const float specularLuminance = luminance(fresnel(cosOut));
        const float diffuseLuminance = luminance(diffuse);
        if (!(diffuseLuminance > 0.0f)) return 1.0f;
        return std::clamp(specularLuminance / (specularLuminance + diffuseLuminance), 0.1f, 0.9f);
    }

    /// Value for any direction `in`; without a mirror's delta lobe.
    BsdfValue evaluate(const glm::vec3& out, const glm::vec3& in, const glm::vec3& n) const {
        const float cosIn = glm::dot(n, in);
        if (!(cosIn > 0.0f)) return {};
        if (!hasSpecular()) return {diffuse * (cosIn * kInvPi), cosIn * kInvPi};
        return evaluateLayers(out, in, n, cosIn);
    }

    /// Samples a direction by `u` in [0, 1)²; `uLobe` in [0, 1) selects the lobe.
    BsdfSample sample(const glm::vec3& out, const glm::vec3& n, glm::vec2 u, float uLobe) const {
        const Frame frame(n);
        if (!hasSpecular()) {
            const glm::vec3 local = cosineHemisphere(u.x, u.y);
            // On the rim of the disk z is rounded to 0
            return {frame.toWorld(local), local.z > 0.0f ? diffuse : glm::vec3(0.0f), local.z * kInvPi, false};
        }
        return sampleLayers(out, frame, u, uLobe);
    }

    /// Schlick's Fresnel reflectance at an angle to the half vector.
    glm::vec3 fresnel(float cosHalf) const {
        const float w = schlickWeight(cosHalf);
        return f0 * (1.0f - w) + glm::vec3(f90 * w);
    }

    static float schlickWeight(float cosHalf) {
        const float m = std::clamp(1.0f - cosHalf, 0.0f, 1.0f);
        return square(square(m)) * m;
    }

    /// GGX distribution of half vectors, times pi. @param sin2 1 - cosNormal², without rounding error.
    static float distribution(float cosNormal, float sin2, float alpha) {
        const float a2 = alpha * alpha;
        return a2 / square(cosNormal * cosNormal * a2 + sin2);
    }

 private:
    BsdfValue evaluateLayers(const glm::vec3& out, const glm::vec3& in, const glm::vec3& n, float cosIn) const;
    BsdfSample sampleLayers(const glm::vec3& out, const Frame& frame, glm::vec2 u, float uLobe) const;
};

}  // namespace voxray::path_trace
