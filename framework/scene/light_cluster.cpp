#include "scene/light_cluster.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace voxray {
namespace {

/// A cone that holds both (Conty Estevez and Kulla 2018, algorithm 1).
LightCone unite(const LightCone& one, const LightCone& other) {
    const LightCone &a = one.angle < other.angle ? other : one, &b = one.angle < other.angle ? one : other;
    const double alike = glm::dot(a.axis, b.axis);
    if (a.angle >= std::numbers::pi || alike >= a.cosine * b.cosine + a.sine * b.sine) return a;
    const glm::dvec3 across = glm::cross(a.axis, b.axis);
    const double sine = glm::length(across), between = std::atan2(sine, alike);
    if (between + b.angle <= a.angle) return a;
    const double angle = 0.5 * (a.angle + between + b.angle);
    if (angle >= std::numbers::pi || !(sine > 0)) return {};
    // Rodrigues' formula; `across` is perpendicular to the axis
    const double turn = angle - a.angle;
    return {std::cos(turn) * a.axis + std::sin(turn) * glm::cross(across / sine, a.axis), angle};
}

/// A corner of bounds in steps of its parent's size, in the direction of `towards`: -1 down, 1 up.
uint32_t packedCorner(const glm::vec3& corner, const glm::vec3& low, const glm::vec3& size, int towards) {
    uint32_t packed = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto steps = int(LIGHT_TREE_BOUNDS_STEPS);
        int step = size[axis] > 0 ? int(std::lround((corner[axis] - low[axis]) / size[axis] * float(steps))) : 0;
        step = std::clamp(step, 0, steps);
        const auto isOutside = [&] {
            const uint32_t at = uint32_t(step) << (10 * axis);
            const float decoded = gpu::lightTreeCorner(at, low, size)[axis];
            return towards < 0 ? decoded <= corner[axis] : decoded >= corner[axis];
        };
        while (!isOutside() && step + towards >= 0 && step + towards <= steps) step += towards;
        packed |= uint32_t(step) << (10 * axis);
    }
    return packed;
}

uint32_t packedAxis(const glm::dvec3& axis) {
    const double sum = std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z);
    glm::dvec2 p = glm::dvec2(axis) / sum;
    if (axis.z < 0) p = {(1 - std::abs(p.y)) * (p.x >= 0 ? 1 : -1), (1 - std::abs(p.x)) * (p.y >= 0 ? 1 : -1)};
    const auto packed = [](double v) { return uint32_t(std::lround((v + 1) * double(LIGHT_TREE_AXIS_STEPS))); };
    return packed(p.x) | packed(p.y) << 16;
}

/// `emission` of a node. The cone may grow by rounding, never shrink, and intensity is never 0.
uint32_t packedEmission(const LightCluster& all, double ofParent) {
    const auto cosO = uint32_t(0.5 * (all.cone.cosine + 1) * double(LIGHT_TREE_COS_ORIENTATION_STEPS) + 1e-6);
    const auto cosEmission =
        uint32_t(std::max(std::cos(all.emission), 0.0) * double(LIGHT_TREE_COS_EMISSION_STEPS) + 1e-6);
    const double steps = all.intensity / ofParent * double(LIGHT_TREE_INTENSITY_STEPS);
    const auto intensity = uint32_t(std::clamp(std::round(steps), 1.0, double(LIGHT_TREE_INTENSITY_STEPS)));
    return intensity | cosO << LIGHT_TREE_COS_ORIENTATION_SHIFT | cosEmission << LIGHT_TREE_COS_EMISSION_SHIFT |
           (all.doubleSided ? LIGHT_TREE_DOUBLE_SIDED : 0u);
}

}  // namespace

LightCluster LightCluster::of(const BoundedLight& l) {
    const double orientation = std::acos(double(l.cosOrientation));
    return {l.bounds, l.intensity, {glm::dvec3(l.axis), orientation}, std::acos(double(l.cosEmission)), l.doubleSided};
}

void LightCluster::add(const LightCluster& other) {
    if (other.empty()) return;
    cone = empty() ? other.cone : unite(cone, other.cone);
    bounds.include(other.bounds);
    intensity += other.intensity;
    emission = std::max(emission, other.emission);
    doubleSided = doubleSided || other.doubleSided;
}

double LightCluster::cost() const {
    if (empty()) return 0;
    const double o = cone.angle, w = std::min(o + emission, std::numbers::pi);
    const double directions =
        2 * std::numbers::pi * (1 - cone.cosine) +
        0.5 * std::numbers::pi * (2 * w * cone.sine - std::cos(o - 2 * w) - 2 * o * cone.sine + cone.cosine);
    const glm::dvec3 diagonal = bounds.max - bounds.min;
    return intensity * directions * glm::dot(diagonal, diagonal);
}

gpu::LightTreeSummary summaryOf(const LightCluster& cluster, const LightCluster& above) {
    const glm::vec3 low = above.bounds.min, size = above.bounds.max - above.bounds.min;
    return {packedCorner(cluster.bounds.min, low, size, -1), packedCorner(cluster.bounds.max, low, size, 1),
            packedAxis(cluster.cone.axis), packedEmission(cluster, above.intensity)};
}

}  // namespace voxray
