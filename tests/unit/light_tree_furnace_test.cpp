// The light tree inside of what emits: all light is picked, also next to large lamps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tests/support/tree_lights.h"

namespace voxray {
namespace {

/// Probability that a choice ends at a node of which no light reaches the surface.
double deadEnds(const LightTree& tree, const LightTree::Receiver& to) {
    double sum = 0;
    for (uint32_t node = 0; node < tree.nodes().size(); ++node) {
        const uint32_t link = tree.nodes()[node].link, first = link & LIGHT_TREE_FIRST_CHILD;
        if ((link & LIGHT_TREE_LEAF) != 0) continue;
        const double ofNode = node == 0 ? 1 : double(tree.probability(node, to));
        double ofChildren = 0;
        for (uint32_t k = 0; k < link >> LIGHT_TREE_COUNT_SHIFT; ++k)
            ofChildren += double(tree.probability(first + k, to));
        if (ofChildren == 0) sum += ofNode;
    }
    return sum;
}

/// The inside of a sphere, which emits: an octahedron of which each triangle is divided into four, three times.
std::vector<TestLight> emissiveSphere() {
    std::vector<std::array<glm::vec3, 3>> triangles;
    for (const float x : {-1.0f, 1.0f})
        for (const float y : {-1.0f, 1.0f})
            for (const float z : {-1.0f, 1.0f}) triangles.push_back({glm::vec3(x, 0, 0), {0, y, 0}, {0, 0, z}});
    for (int level = 0; level < 3; ++level) {
        std::vector<std::array<glm::vec3, 3>> finer;
        for (const auto& [a, b, c] : triangles) {
            const glm::vec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        triangles = finer;
    }
    std::vector<TestLight> lights;
    for (const auto& corners : triangles) {
        TestLight light{.bounded = {}, .punctual = {}, .corner = corners[0]};
        light.edge1 = corners[1] - corners[0];
        light.edge2 = corners[2] - corners[0];
        glm::vec3 across = glm::cross(light.edge1, light.edge2);
        if (glm::dot(across, light.corner) > 0) across = -across;
        light.bounded = boundedLight(corners, glm::normalize(across), 0.5 * double(glm::length(across)), 1, false,
                                     uint32_t(lights.size()));
        lights.push_back(light);
    }
    return lights;
}

TEST(LightTree, ProbabilitiesOfLightsAndOfDeadEndsSumToOne) {
    UniformRandom uniform(7);
    const std::vector<TestLight> sphere = emissiveSphere();
    for (const bool isSphere : {false, true}) {
        const std::vector<BoundedLight> lights = bounded(isSphere ? sphere : manyLights(500, 1, 4));
        const LightTree tree(lights);
        for (int k = 0; k < 100; ++k) {
            LightTree::Receiver to{inCube(uniform, 2), unitVector(uniform)};
            if (isSphere) {
                const TestLight& on = sphere[uniform.below(uint32_t(sphere.size()))];
                to.normal = on.bounded.axis;
                to.position = on.corner + 0.3f * on.edge1 + uniform(0, 0.7f) * on.edge2 + 1e-5f * to.normal;
            }
            double sum = deadEnds(tree, to);
            for (size_t i = 0; i < lights.size(); ++i) sum += double(tree.probability(tree.leaf(i), to));
            ASSERT_NEAR(sum, 1, 1e-5);
        }
    }
}

/// Irradiance of a triangle of radiance 1 that lies above a surface's plane (Lambert 1760).
double irradianceOf(const TestLight& light, const LightTree::Receiver& to) {
    const glm::dvec3 corner = glm::dvec3(light.corner) - glm::dvec3(to.position);
    const glm::dvec3 v[] = {glm::normalize(corner), glm::normalize(corner + glm::dvec3(light.edge1)),
                            glm::normalize(corner + glm::dvec3(light.edge2))};
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 across = glm::cross(v[i], v[(i + 1) % 3]);
        const double sine = glm::length(across);
        sum += std::atan2(sine, glm::dot(v[i], v[(i + 1) % 3])) / sine * glm::dot(across, glm::dvec3(to.normal));
    }
    return 0.5 * std::abs(sum);
}

TEST(LightTree, LightsThatItPicksInAFurnaceBringAllOfItsLight) {
    // Each triangle with a probability has its whole irradiance in the mean, the others have none
    const std::vector<TestLight> sphere = emissiveSphere();
    const LightTree tree(bounded(sphere));
    UniformRandom uniform(9);
    for (int k = 0; k < 200; ++k) {
        const size_t on = uniform.below(uint32_t(sphere.size()));
        LightTree::Receiver to{{}, sphere[on].bounded.axis};
        to.position = sphere[on].corner + 0.3f * sphere[on].edge1 + uniform(0, 0.7f) * sphere[on].edge2;
        double found = 0;
        for (size_t i = 0; i < sphere.size(); ++i)
            if (i != on && tree.probability(tree.leaf(i), to) > 0) found += irradianceOf(sphere[i], to);
        ASSERT_NEAR(found, std::numbers::pi, 1e-4);
    }
}

TEST(LightTree, PicksLargeLampsByTheirLightNextToThem) {
    // The second moment of a sample is bounded on the floor of a box that emits, however near a wall is. Where a wall
    // is weighed by the cosine to its center, this grows with one over the distance
    std::vector<TestLight> walls;
    const auto addWall = [&](const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
        for (const bool isSecond : {false, true}) {
            TestLight light{.bounded = {}, .punctual = {}, .corner = corner};
            light.edge1 = isSecond ? u + v : u;
            light.edge2 = isSecond ? v : u + v;
            const glm::vec3 corners[] = {corner, corner + light.edge1, corner + light.edge2};
            light.bounded =
                boundedLight(corners, glm::normalize(glm::cross(u, v)), 2, 1, false, uint32_t(walls.size()));
            walls.push_back(light);
        }
    };
    addWall({-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
    addWall({-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
    addWall({-1, -1, 1}, {0, 2, 0}, {2, 0, 0});
    addWall({-1, -1, -1}, {0, 2, 0}, {0, 0, 2});
    addWall({1, -1, -1}, {0, 0, 2}, {0, 2, 0});
    const LightTree tree(bounded(walls));
    UniformRandom uniform(1);
    for (const float distance : {0.5f, 0.1f, 1e-2f, 1e-3f, 1e-4f}) {
        double worst = 0;
        for (int k = 0; k < 200; ++k) {
            const LightTree::Receiver to{{1 - distance, -1 + 1e-6f, k % 4 == 0 ? 1 - distance : uniform(-1, 1)},
                                         {0, 1, 0}};
            double light = 0, squares = 0;
            for (size_t i = 0; i < walls.size(); ++i) {
                const double one = irradianceOf(walls[i], to);
                light += one;
                squares += one * one / double(tree.probability(tree.leaf(i), to));
            }
            ASSERT_NEAR(light, std::numbers::pi, 1e-2);
            worst = std::max(worst, squares / (light * light));
        }
        std::printf("%g m: second moment at most %.2f\n", double(distance), worst);
        EXPECT_LT(worst, 4) << distance;
    }
}

}  // namespace
}  // namespace voxray
