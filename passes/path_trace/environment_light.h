#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/scene.h"

namespace voxray::path_trace {

/// Light from infinitely far. A constant environment needs no sampling of its own: reflection sampling meets
/// it everywhere. A map is drawn by brightness: rows, then columns, by inverting cumulative sums.
class EnvironmentLight {
 public:
    /// `environment` must outlive this object.
    explicit EnvironmentLight(const Environment& environment);

    bool isBlack() const { return black_; }
    bool hasMap() const { return !columnSums_.empty(); }
    /// Mean luminance over all directions, W/(m² sr).
    float meanLuminance() const { return meanLuminance_; }

    /// Radiance that arrives along a unit `direction` pointing away from the scene. The map is bilinear.
    glm::vec3 radiance(const glm::vec3& direction) const;

    /// Density per steradian with which `sample` draws a direction; maps only.
    float pdf(const glm::vec3& direction) const;
    glm::vec3 sample(float u, float v, float& pdf) const;

 private:
    glm::vec2 toMap(const glm::vec3& direction) const;
    float pdfOfTexel(uint32_t x, uint32_t y, float sinTheta) const;

    const Environment* environment_;
    uint32_t width_ = 0, height_ = 0;
    bool black_ = true;
    float meanLuminance_ = 0.0f;
    std::vector<float> rowSums_;     ///< height + 1 entries from 0 to 1.
    std::vector<float> columnSums_;  ///< (width + 1) entries a row, each row from 0 to 1.
};

}  // namespace voxray::path_trace
