#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>

#include "scene/bounded_light.h"
#include "shaders/scene/light_tree_types.h"

namespace voxray {

/// Directions within an angle of an axis.
struct LightCone {
    glm::dvec3 axis{0, 0, 1};
    double angle = std::numbers::pi, cosine = -1, sine = 0;  ///< All directions.

    LightCone() = default;
    LightCone(const glm::dvec3& of, double half)
        : axis(of), angle(half), cosine(std::cos(half)), sine(std::sin(half)) {}
};

/// Bounds of some lights: a node of a light tree while it is built (Conty Estevez and Kulla 2018).
struct LightCluster {
    Box bounds = Box::empty();
    double intensity = 0;
    LightCone cone{};
    double emission = 0;  ///< Radians.
    bool doubleSided = false;

    static LightCluster of(const BoundedLight& light);
    bool empty() const { return !(intensity > 0); }
    void add(const LightCluster& other);

    /// Surface area orientation heuristic (section 4.4), with the squared diagonal of the bounds for their area, as
    /// the importance depends on the radius of the bounds. Lights on a line then have a cost, too.
    double cost() const;
};

/// A cluster as its parent `above` has it, rounded so that it covers its lights.
gpu::LightTreeSummary summaryOf(const LightCluster& cluster, const LightCluster& above);

}  // namespace voxray
