#include "passes/path_trace/bsdf.h"

#include <glm/common.hpp>

namespace voxray::path_trace {

namespace {

/// sqrt(alpha² + (1 - alpha²) cos²), of Smith's masking terms.
float smithRoot(float cosine, float alpha) {
    const float a2 = alpha * alpha;
    return std::sqrt(a2 + (1.0f - a2) * cosine * cosine);
}

/// Samples a half vector visible from `out` (local frame, +Z the normal). Dupuy and Benyoub 2023, "Sampling
/// Visible GGX Normals with Spherical Caps".
glm::vec3 sampleVisibleNormal(const glm::vec3& out, float alpha, float u, float v) {
    const glm::vec3 stretched = glm::normalize(glm::vec3(out.x * alpha, out.y * alpha, out.z));
    const float phi = 2.0f * kPi * u;
    const float z = (1.0f - v) * (1.0f + stretched.z) - stretched.z;
    const float sine = std::sqrt(std::clamp(1.0f - z * z, 0.0f, 1.0f));
    const glm::vec3 h = glm::vec3(sine * std::cos(phi), sine * std::sin(phi), z) + stretched;
    return glm::normalize(glm::vec3(h.x * alpha, h.y * alpha, std::max(h.z, 1e-7f)));
}

}  // namespace

BsdfValue Bsdf::evaluateLayers(const glm::vec3& out, const glm::vec3& in, const glm::vec3& n, float cosIn) const {
    const float cosOut = std::max(glm::dot(n, out), 1e-5f);
    const glm::vec3 sum = out + in;
    const float length2 = glm::dot(sum, sum);
    if (!(length2 > 0.0f)) return {};
    const glm::vec3 half = sum / std::sqrt(length2);
    const float cosHalf = glm::dot(out, half);
    const float pSpecular = specularProbability(cosOut);

    // Lambert under the dielectric layer
    const float w = schlickWeight(cosHalf);
    const float transmitted = 1.0f - (dielectricF0 * (1.0f - w) + dielectricF90 * w);
    BsdfValue value;
    value.fCos = diffuse * (transmitted * cosIn * kInvPi);
    value.pdf = (1.0f - pSpecular) * cosIn * kInvPi;
    if (isMirror()) return value;

    // GGX with height-correlated Smith masking
    const glm::vec3 across = glm::cross(n, half);
    const float d = distribution(glm::dot(n, half), glm::dot(across, across), alpha) * kInvPi;
    const float rootOut = smithRoot(cosOut, alpha), rootIn = smithRoot(cosIn, alpha);
    const float visibility = 0.5f / (cosIn * rootOut + cosOut * rootIn);
    value.fCos += fresnel(cosHalf) * (d * visibility * cosIn);
    value.pdf += pSpecular * d * 0.5f / (cosOut + rootOut);
    return value;
}

BsdfSample Bsdf::sampleLayers(const glm::vec3& out, const Frame& frame, glm::vec2 u, float uLobe) const {
    glm::vec3 local = frame.toLocal(out);
    local.z = std::max(local.z, 1e-5f);
    const float pSpecular = specularProbability(local.z);
    BsdfSample sample;

    // A delta lobe has no other density
    if (uLobe < pSpecular && isMirror()) {
        sample.direction = frame.toWorld({-local.x, -local.y, local.z});
        sample.weight = fresnel(local.z) / pSpecular;
        sample.isMirror = true;
        return sample;
    }

    // One lobe samples the direction, both contribute
    glm::vec3 in;
    if (uLobe < pSpecular) {
        const glm::vec3 half = sampleVisibleNormal(local, alpha, u.x, u.y);
        in = glm::normalize(half * (2.0f * glm::dot(local, half)) - local);
    } else {
        in = cosineHemisphere(u.x, u.y);
    }
    if (!(in.z > 0.0f)) return sample;
    sample.direction = frame.toWorld(in);
    const BsdfValue value = evaluateLayers(out, sample.direction, frame.z, in.z);
    if (!(value.pdf > 0.0f)) return sample;
    sample.weight = value.fCos / value.pdf;
    sample.pdf = value.pdf;
    return sample;
}

}  // namespace voxray::path_trace
