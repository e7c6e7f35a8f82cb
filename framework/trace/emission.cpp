#include "trace/emission.h"

#include <algorithm>
#include <glm/common.hpp>

#include "trace/texture_lookup.h"

namespace voxray {
namespace {

/// Sample points along an edge of the unit square that is folded onto a triangle.
constexpr uint32_t kEdgePoints = 4;
/// Lower bound of the mean, as a fraction of the emission factor: for emission between the points.
constexpr float kMinFraction = 0.01f;

const Material& materialOf(const SceneState& state, uint32_t triangle) {
    return state.scene->materials[state.geometry.triangleMaterials[triangle]];
}

/// Range of the factor times the interpolated vertex alpha.
struct AlphaRange {
    float lowest, highest;
};
AlphaRange alphaRange(const SceneState& state, uint32_t triangle) {
    const Geometry& g = state.geometry;
    const glm::uvec3 v = g.triangles[triangle];
    const auto [lowest, highest] =
        std::minmax({g.attributes[v.x].color.a, g.attributes[v.y].color.a, g.attributes[v.z].color.a});
    const float factor = materialOf(state, triangle).baseColor.a;
    return {factor * lowest, factor * highest};
}

glm::vec3 emissionAt(const SceneState& state, uint32_t triangle, float u, float v) {
    const Material& m = materialOf(state, triangle);
    if (m.alphaMode == AlphaMode::Mask && isCutAway(state, triangle, u, v)) return glm::vec3(0.0f);
    if (m.emissiveTexture.texture < 0) return m.emission;
    return m.emission * glm::vec3(sampleTexture(state, m.emissiveTexture, triangle, u, v));
}

}  // namespace

bool canEmit(const SceneState& state, uint32_t triangle) {
    const Material& m = materialOf(state, triangle);
    if (!(std::max({m.emission.r, m.emission.g, m.emission.b}) > 0)) return false;
    return m.alphaMode != AlphaMode::Mask || alphaRange(state, triangle).highest >= alphaThreshold(m);
}

glm::vec3 meanEmission(const SceneState& state, uint32_t triangle) {
    if (!canEmit(state, triangle)) return glm::vec3(0.0f);
    const Material& m = materialOf(state, triangle);
    const bool isUniform = m.alphaMode != AlphaMode::Mask ||
                           (m.baseColorTexture.texture < 0 && alphaRange(state, triangle).lowest >= alphaThreshold(m));
    if (isUniform && m.emissiveTexture.texture < 0) return m.emission;
    glm::vec3 sum(0.0f);
    for (uint32_t i = 0; i < kEdgePoints * kEdgePoints; ++i) {
        float u = (float(i % kEdgePoints) + 0.5f) / float(kEdgePoints),
              v = (float(i / kEdgePoints) + 0.25f) / float(kEdgePoints);
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        sum += emissionAt(state, triangle, u, v);
    }
    return glm::max(sum / float(kEdgePoints * kEdgePoints), kMinFraction * m.emission);
}

}  // namespace voxray
