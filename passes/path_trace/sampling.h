#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/luminance.h"

/// Sampling warps of the unit square, and discrete distributions.
namespace voxray::path_trace {

constexpr float kPi = 3.14159265358979f;
constexpr float kInvPi = 0.318309886183791f;

inline float maxComponent(const glm::vec3& c) {
    return std::max(c.x, std::max(c.y, c.z));
}
inline float square(float x) {
    return x * x;
}

/// Orthonormal right-handed frame around the unit vector z. Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited".
struct Frame {
    glm::vec3 x, y, z;

    explicit Frame(const glm::vec3& n) : z(n) {
        const float sign = std::copysign(1.0f, n.z);
        const float a = -1.0f / (sign + n.z);
        const float b = n.x * n.y * a;
        x = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
        y = {b, sign + n.y * n.y * a, -n.y};
    }
    glm::vec3 toWorld(const glm::vec3& v) const { return x * v.x + y * v.y + z * v.z; }
    glm::vec3 toLocal(const glm::vec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
};

/// Sine and cosine of an angle in [-pi/4, pi/4], to 2e-7.
inline void sinCosSmall(float a, float& sine, float& cosine) {
    const float s = a * a;
    sine = a * (1.0f + s * (-1.0f / 6 + s * (1.0f / 120 + s * (-1.0f / 5040))));
    cosine = 1.0f + s * (-0.5f + s * (1.0f / 24 + s * (-1.0f / 720 + s * (1.0f / 40320))));
}

/// Uniform on the unit disk. Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square".
inline glm::vec2 uniformDisk(float u, float v) {
    const float a = 2.0f * u - 1.0f, b = 2.0f * v - 1.0f;
    if (a == 0.0f && b == 0.0f) return {0.0f, 0.0f};
    float sine, cosine;
    if (a * a > b * b) {
        sinCosSmall(0.25f * kPi * b / a, sine, cosine);
        return {a * cosine, a * sine};
    }
    sinCosSmall(0.25f * kPi * a / b, sine, cosine);
    return {b * sine, b * cosine};
}

/// Cosine-distributed on the hemisphere around +Z; pdf cos / pi.
inline glm::vec3 cosineHemisphere(float u, float v) {
    const glm::vec2 d = uniformDisk(u, v);
    return {d.x, d.y, std::sqrt(std::max(0.0f, 1.0f - d.x * d.x - d.y * d.y))};
}

/// Barycentric coordinates of the second and third corner, uniform on a triangle. Heitz 2019, "A
/// Low-Distortion Map Between Triangle and Square".
inline glm::vec2 uniformTriangle(float u, float v) {
    if (v > u) {
        u *= 0.5f;
        v -= u;
    } else {
        v *= 0.5f;
        u -= v;
    }
    return {u, v};
}

/// MIS weight of a sample with density `pdf` where another technique has `otherPdf`: power heuristic with
/// exponent 2. Veach 1997, section 9.2.
inline float misWeight(float pdf, float otherPdf) {
    const float ratio = otherPdf / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

/// Discrete distribution by Vose's alias method (1991): constant time per draw.
class AliasTable {
 public:
    AliasTable() = default;
    /// @param weights finite, not negative; the table is empty where all are 0.
    explicit AliasTable(std::span<const double> weights);

    /// A draw of this entry below the threshold, of the alias above it.
    struct Bin {
        float threshold;
        uint32_t alias;
        float probability;
    };

    bool empty() const { return bins_.empty(); }
    std::span<const Bin> bins() const { return bins_; }
    float probability(uint32_t i) const { return bins_[i].probability; }

    uint32_t draw(float u) const {
        const float scaled = u * float(bins_.size());
        const uint32_t i = std::min(uint32_t(scaled), uint32_t(bins_.size() - 1));
        return scaled - float(i) < bins_[i].threshold ? i : bins_[i].alias;
    }

 private:
    std::vector<Bin> bins_;
};

}  // namespace voxray::path_trace
