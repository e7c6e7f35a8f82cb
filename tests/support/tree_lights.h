#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "scene/light_tree.h"
#include "scene/uniform_random.h"

namespace voxray {

inline glm::vec3 unitVector(UniformRandom& uniform) {
    glm::vec3 v;
    do {
        v = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    } while (glm::dot(v, v) > 1 || glm::dot(v, v) < 1e-4f);
    return glm::normalize(v);
}

inline glm::vec3 inCube(UniformRandom& uniform, float half) {
    return {uniform(-half, half), uniform(-half, half), uniform(-half, half)};
}

/// A light with what it is, to compute its light by hand.
struct TestLight {
    BoundedLight bounded;
    std::optional<Light> punctual;
    glm::vec3 corner{0.0f}, edge1{0.0f}, edge2{0.0f};

    /// Whether a surface may get light of it from the point (a, b) of a triangle, in double.
    bool reaches(const glm::dvec3& position, const glm::dvec3& normal, double a, double b) const {
        const glm::dvec3 from = punctual ? glm::dvec3(punctual->position)
                                         : glm::dvec3(corner) + a * glm::dvec3(edge1) + b * glm::dvec3(edge2);
        const glm::dvec3 direction = glm::normalize(from - position);
        constexpr double kEdge = 1e-4;  // Light that comes in along the surface, or leaves the lamp along it
        if (glm::dot(direction, normal) < kEdge) return false;
        if (punctual && punctual->type == LightType::Point) return true;
        const double along = -glm::dot(glm::dvec3(bounded.axis), direction);
        if (punctual) return along > std::cos(double(punctual->outerConeAngle)) + kEdge;
        return (bounded.doubleSided ? std::abs(along) : along) > kEdge;
    }
};

/// Points, spots, triangles with one and two sides in a cube of 2 m, `spread` of that apart.
inline std::vector<TestLight> manyLights(uint32_t count, float spread, uint32_t seed) {
    UniformRandom uniform(seed);
    std::vector<TestLight> lights;
    for (uint32_t i = 0; i < count; ++i) {
        TestLight light;
        const glm::vec3 place = inCube(uniform, spread), direction = unitVector(uniform);
        if (i % 4 < 2) {
            light.punctual = Light{.name = {},
                                   .type = i % 4 == 0 ? LightType::Point : LightType::Spot,
                                   .intensity = glm::vec3(uniform(0.1f, 3)),
                                   .innerConeAngle = 0.1f,
                                   .outerConeAngle = uniform(0.2f, 0.5f * std::numbers::pi_v<float>),
                                   .position = place,
                                   .direction = direction};
            light.bounded = *boundedLight(*light.punctual, i);
        } else {
            light.corner = place;
            light.edge1 = 0.3f * unitVector(uniform);
            light.edge2 = 0.3f * unitVector(uniform);
            const glm::vec3 corners[] = {place, place + light.edge1, place + light.edge2};
            const glm::vec3 across = glm::cross(light.edge1, light.edge2);
            light.bounded = boundedLight(corners, glm::normalize(across), 0.5 * double(glm::length(across)),
                                         double(uniform(1, 20)), i % 4 == 3, i);
        }
        lights.push_back(light);
    }
    return lights;
}

inline std::vector<BoundedLight> bounded(const std::vector<TestLight>& lights) {
    std::vector<BoundedLight> all;
    for (const TestLight& light : lights) all.push_back(light.bounded);
    return all;
}

}  // namespace voxray
