#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "trace/environment_cdf.h"

namespace voxray::path_trace {

/// Light from infinitely far. A constant environment is not sampled: reflection sampling finds it everywhere.
/// A map is sampled by luminance: rows, then columns, by inverting CDFs (PBRT 12.5).
class EnvironmentLight {
 public:
    /// @param environment must outlive this object.
    explicit EnvironmentLight(const Environment& environment);

    bool isBlack() const { return !(cdf_.meanLuminance > 0.0f); }
    bool hasMap() const { return cdf_.width > 0; }
    /// Mean luminance over all directions, W/(m² sr).
    float meanLuminance() const { return cdf_.meanLuminance; }

    /// Radiance from a unit `direction` that points away from the scene; the map is interpolated bilinearly.
    glm::vec3 radiance(const glm::vec3& direction) const;

    /// Density of sample(), per steradian; maps only.
    float pdf(const glm::vec3& direction) const;
    glm::vec3 sample(float u, float v, float& pdf) const;

 private:
    glm::vec2 texelCoordinates(const glm::vec3& direction) const;
    float texelPdf(uint32_t x, uint32_t y, float sinTheta) const;

    const Environment* environment_;
    EnvironmentCdf cdf_;
};

}  // namespace voxray::path_trace
