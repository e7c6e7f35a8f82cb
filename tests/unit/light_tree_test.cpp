// The light tree: its probabilities, and where they may be 0.
#include "scene/light_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <map>

#include "scene/uniform_random.h"

namespace voxray {
namespace {

constexpr float kPi = 3.14159265358979f;

glm::vec3 unitVector(UniformRandom& uniform) {
    glm::vec3 v;
    do {
        v = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    } while (glm::dot(v, v) > 1 || glm::dot(v, v) < 1e-4f);
    return glm::normalize(v);
}

glm::vec3 inCube(UniformRandom& uniform, float half) {
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
std::vector<TestLight> manyLights(uint32_t count, float spread, uint32_t seed) {
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
                                   .outerConeAngle = uniform(0.2f, 0.5f * kPi),
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

std::vector<BoundedLight> bounded(const std::vector<TestLight>& lights) {
    std::vector<BoundedLight> all;
    for (const TestLight& light : lights) all.push_back(light.bounded);
    return all;
}

TEST(LightTree, PicksEachLightAsOftenAsItsProbabilitySays) {
    // Each light has an interval of u; together with those of dead ends these are [0, 1)
    UniformRandom uniform(3);
    for (const size_t group : {0, 40}) {
        const LightTree tree(bounded(manyLights(200, 1, 1)), group);
        for (int k = 0; k < 30; ++k) {
            const glm::vec3 position = inCube(uniform, 2), normal = unitVector(uniform);
            constexpr int kPicks = 1 << 14;
            std::map<uint32_t, int> found;
            for (int i = 0; i < kPicks; ++i) {
                const LightTree::Pick pick = tree.pick({position, normal}, (float(i) + 0.5f) / kPicks);
                if (pick.probability == 0) continue;
                ++found[pick.id];
                ASSERT_NEAR(pick.probability / tree.probability(tree.leaf(pick.id), {position, normal}), 1, 1e-4f);
            }
            double sum = 0;
            int picks = 0;
            for (uint32_t light = 0; light < 200; ++light) {
                const double probability = double(tree.probability(tree.leaf(light), {position, normal}));
                ASSERT_NEAR(found[light], probability * kPicks, 1 + 1e-3 * kPicks * probability);
                sum += probability;
                picks += found[light];
            }
            ASSERT_NEAR(sum, double(picks) / kPicks, 2e-3);
            ASSERT_LE(sum, 1 + 1e-5);
        }
    }
}

TEST(LightTree, ProbabilitiesSumToOneWhereAllLightsReachTheSurface) {
    for (const uint32_t count : {1u, 2u, 3u, 10u, 1000u, 10000u}) {
        std::vector<BoundedLight> lights;
        UniformRandom uniform(count);
        for (uint32_t i = 0; i < count; ++i) {
            Light light{.name = {}, .intensity = glm::vec3(uniform(0.1f, 3)), .position = inCube(uniform, 1)};
            lights.push_back(*boundedLight(light, i));
        }
        const LightTree tree(lights);
        for (int k = 0; k < 10; ++k) {
            const glm::vec3 position = inCube(uniform, 1) - glm::vec3(0, 2.5f, 0);
            double sum = 0;
            for (uint32_t i = 0; i < count; ++i) sum += double(tree.probability(tree.leaf(i), {position, {0, 1, 0}}));
            EXPECT_NEAR(sum, 1, 1e-5) << count;
        }
    }
}

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
        ASSERT_NEAR(found, double(kPi), 1e-4);
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
            ASSERT_NEAR(light, double(kPi), 1e-2);
            worst = std::max(worst, squares / (light * light));
        }
        std::printf("%g m: second moment at most %.2f\n", double(distance), worst);
        EXPECT_LT(worst, 4) << distance;
    }
}

TEST(LightTree, NeverMissesALightThatReachesTheSurface) {
    UniformRandom uniform(11);
    for (const float spread : {0.05f, 1.0f, 10.0f}) {
        const std::vector<TestLight> lights = manyLights(64, spread, uint32_t(10 * spread));
        const LightTree tree(bounded(lights));
        size_t reached = 0, missed = 0;
        for (int k = 0; k < 2000; ++k) {
            const glm::vec3 position = inCube(uniform, 1.5f * spread), normal = unitVector(uniform);
            for (uint32_t i = 0; i < lights.size(); ++i) {
                float a = uniform(0, 1), b = uniform(0, 1);
                if (a + b > 1) a = 1 - a, b = 1 - b;
                if (!lights[i].reaches(position, normal, double(a), double(b))) continue;
                ++reached;
                missed += tree.probability(tree.leaf(i), {position, normal}) == 0 ? 1 : 0;
            }
        }
        EXPECT_GT(reached, 10000u);
        EXPECT_EQ(missed, 0u) << spread;
    }
}

TEST(LightTree, LeavesOutLightsBehindTheSurfaceAndThoseThatLookAway) {
    Light up{.name = {}, .position = {0, 1, 0}}, down{.name = {}, .position = {0, -1, 0}},
        spot{
            .name = {}, .type = LightType::Spot, .outerConeAngle = 0.5f, .position = {0, 2, 0}, .direction = {0, 1, 0}};
    const std::vector<BoundedLight> lights{*boundedLight(up, 0), *boundedLight(down, 1), *boundedLight(spot, 2)};
    const LightTree tree(lights);
    EXPECT_EQ(tree.probability(tree.leaf(0), {{0, 0, 0}, {0, 1, 0}}), 1.0f);
    EXPECT_EQ(tree.pick({{0, 0, 0}, {0, -1, 0}}, 0.9f).id, 1u);
    EXPECT_EQ(tree.pick({{0, 0, 0}, {0, -1, 0}}, 0.9f).probability, 1.0f);
    EXPECT_EQ(tree.pick({{0, 3, 0}, {0, 1, 0}}, 0.5f).probability, 0.0f);
}

TEST(LightTree, EstimatesTheIrradianceOfSmallLightsExactly) {
    const Light point{.name = {}, .intensity = glm::vec3(3), .position = {0, 2, 0}};
    EXPECT_NEAR(LightTree(std::vector{*boundedLight(point, 0)}).irradiance({1, 0, 0}, {0, 1, 0}),
                3 / 5.0f * 2 / std::sqrt(5.0f), 1e-5);
    // One centimetre, turned away by 60 degrees
    const glm::vec3 corners[] = {{0, 2, 0}, {0.01f, 2, 0}, {0, 2, 0.01f}};
    const BoundedLight lamp = boundedLight(corners, {std::sqrt(0.75f), -0.5f, 0}, 5e-5, 8, false, 0);
    EXPECT_NEAR(LightTree(std::vector{lamp}).irradiance({0, 0, 0}, {0, 1, 0}), 8 * 5e-5 * 0.5 / 4, 2e-6);
}

TEST(LightTree, IsNearToIrradianceInItsChoice) {
    // A light at a tenth of the distance has a hundredfold probability
    std::vector<BoundedLight> lights;
    for (uint32_t i = 0; i < 8; ++i) {
        const Light light{.name = {}, .position = {0, i == 3 ? 1.0f : 10.0f, 0.2f * float(i)}};
        lights.push_back(*boundedLight(light, i));
    }
    const LightTree tree(lights);
    EXPECT_NEAR(tree.probability(tree.leaf(3), {{0, 0, 0.6f}, {0, 1, 0}}), 100.0 / 107, 0.03);
}

/// Radiant intensity of a point light or a spot towards a direction, luminance.
double intensityTowards(const Light& light, const glm::dvec3& direction) {
    const double inner = std::cos(double(light.innerConeAngle)), outer = std::cos(double(light.outerConeAngle));
    const double t = (glm::dot(glm::dvec3(light.direction), direction) - outer) / (inner - outer);
    const double falloff = light.type == LightType::Spot ? std::pow(std::clamp(t, 0.0, 1.0), 2) : 1;
    return double(light.intensity.x) * falloff;
}

TEST(LightTree, VarianceOfASampleHardlyGrowsWithTheNumberOfLights) {
    // Exact, unoccluded: points and spots at random in a hall, seen by floor and ceiling
    std::vector<double> errors;
    for (const uint32_t count : {10u, 100u, 1000u, 10000u}) {
        UniformRandom uniform(1);
        std::vector<Light> lights;
        std::vector<BoundedLight> all;
        for (uint32_t i = 0; i < count; ++i) {
            const glm::vec3 place(uniform(-12, 12), uniform(0.4f, 3.6f), uniform(-12, 12));
            lights.push_back({.name = {},
                              .type = i % 2 == 0 ? LightType::Point : LightType::Spot,
                              .intensity = glm::vec3(i % 2 == 0 ? 1.0f : 8.5f),
                              .innerConeAngle = 0.35f,
                              .outerConeAngle = 0.7f,
                              .position = place,
                              .direction = unitVector(uniform)});
            all.push_back(*boundedLight(lights.back(), i));
        }
        const LightTree tree(all);
        double variance = 0, mean = 0;
        constexpr int kPoints = 200;
        for (int k = 0; k < kPoints; ++k) {
            const glm::vec3 position(uniform(-12, 12), k % 2 == 0 ? 0.0f : 4.0f, uniform(-12, 12)),
                normal(0, k % 2 == 0 ? 1.0f : -1.0f, 0);
            double sum = 0, squares = 0;
            for (uint32_t i = 0; i < count; ++i) {
                const glm::dvec3 toLight = glm::dvec3(lights[i].position) - glm::dvec3(position);
                const double distance = glm::length(toLight), cosine = glm::dot(toLight, glm::dvec3(normal)) / distance;
                const double light = intensityTowards(lights[i], -toLight / distance) * cosine / (distance * distance);
                if (!(light > 0)) continue;
                sum += light;
                squares += light * light / double(tree.probability(tree.leaf(i), {position, normal}));
            }
            variance += (squares - sum * sum) / kPoints;
            mean += sum / kPoints;
        }
        errors.push_back(std::sqrt(variance) / mean);
        std::printf("%u lights: nRMSE of a sample %.3f\n", count, errors.back());
    }
    for (const double error : errors) EXPECT_LT(error, 1);
    EXPECT_LT(errors[3], 1.1 * errors[2]);
}

TEST(LightTree, DependsOnTheRatiosOfIntensitiesAlone) {
    std::vector<BoundedLight> lights = bounded(manyLights(50, 1, 5));
    const LightTree tree(lights);
    for (BoundedLight& light : lights) light.intensity *= 64;
    const LightTree bright(lights);
    UniformRandom uniform(1);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 position = inCube(uniform, 2), normal = unitVector(uniform);
        const float u = uniform(0, 1);
        ASSERT_EQ(tree.pick({position, normal}, u).id, bright.pick({position, normal}, u).id);
        ASSERT_EQ(tree.pick({position, normal}, u).probability, bright.pick({position, normal}, u).probability);
        ASSERT_NEAR(bright.irradiance(position, normal), 64 * tree.irradiance(position, normal),
                    1e-5f * bright.irradiance(position, normal));
    }
}

TEST(LightTree, IsTheSameEachTime) {
    const std::vector<BoundedLight> lights = bounded(manyLights(3000, 1, 9));
    const LightTree a(lights), b(lights);
    ASSERT_LT(a.nodes().size(), 4500u);  // A binary tree has 5999
    ASSERT_EQ(a.nodes().size(), b.nodes().size());
    EXPECT_EQ(std::memcmp(a.nodes().data(), b.nodes().data(), a.nodes().size() * sizeof(gpu::LightTreeNode)), 0);
}

TEST(LightTree, SplitsLightsAtOnePlaceAndOnALineInHalves) {
    for (const float step : {0.0f, 0.001f}) {
        std::vector<BoundedLight> lights;
        for (uint32_t i = 0; i < 4096; ++i)
            lights.push_back(*boundedLight(Light{.name = {}, .position = {step * float(i), 1, 0}}, i));
        const LightTree tree(lights);
        size_t deepest = 0;
        for (size_t i = 0; i < lights.size(); ++i) {
            size_t depth = 0;
            for (uint32_t node = tree.leaf(i); node != 0; node = tree.nodes()[node].parent) ++depth;
            deepest = std::max(deepest, depth);
        }
        EXPECT_LE(deepest, 24u) << step;
        EXPECT_NEAR(tree.probability(tree.leaf(7), {{0, 0, 5}, {0, 1, 0}}), 1.0 / 4096, 2e-4);
    }
}

TEST(LightTree, HasTwoGroupsBelowItsRoot) {
    const std::vector<BoundedLight> lights = bounded(manyLights(100, 1, 2));
    const LightTree tree(lights, 30);
    ASSERT_EQ(tree.nodes()[0].link, 2u << LIGHT_TREE_COUNT_SHIFT | 1u);
    for (size_t i = 0; i < lights.size(); ++i) {
        uint32_t node = tree.leaf(i);
        while (tree.nodes()[node].parent != 0) node = tree.nodes()[node].parent;
        EXPECT_EQ(node, i < 30 ? 1u : 2u);
    }
}

TEST(LightTree, HasFewLightsInOneNode) {
    for (const uint32_t count : {2u, 7u, 12u}) {
        const LightTree tree(bounded(manyLights(count, 1, 2)));
        ASSERT_EQ(tree.nodes().size(), count + 1);
        EXPECT_EQ(tree.nodes()[0].link, count << LIGHT_TREE_COUNT_SHIFT | 1u);
    }
}

TEST(LightTree, PicksLightsBesideItByTheirIrradiance) {
    UniformRandom uniform(5);
    for (const uint32_t count : {0u, 1u, 9u, 200u}) {
        const LightTree tree(bounded(manyLights(count, 1, 1)));
        for (int k = 0; k < 30; ++k) {
            LightTree::Receiver to{inCube(uniform, 2), unitVector(uniform), 0};
            const float irradiance = tree.irradiance(to.position, to.normal);
            to.beside = irradiance > 0 ? uniform(0.1f, 3) * irradiance : 1.0f;
            const float beside = tree.besideProbability(to);
            ASSERT_NEAR(beside, to.beside / (to.beside + irradiance), 1e-4f);
            constexpr int kPicks = 1 << 12;
            std::map<uint32_t, int> found;
            int dead = 0;
            for (int i = 0; i < kPicks; ++i) {
                const LightTree::Pick pick = tree.pick(to, (float(i) + 0.5f) / kPicks);
                ASSERT_TRUE(pick.u >= 0 && pick.u < 1);
                dead += pick.probability == 0 ? 1 : 0;
                if (pick.probability == 0) continue;
                ++found[pick.id];
                const float expected =
                    pick.id == LightTree::kBeside ? beside : tree.probability(tree.leaf(pick.id), to);
                ASSERT_NEAR(pick.probability / expected, 1, 1e-4f);
            }
            ASSERT_NEAR(found[LightTree::kBeside], beside * kPicks, 2);
            double sum = double(beside);
            for (uint32_t light = 0; light < count; ++light) sum += double(tree.probability(tree.leaf(light), to));
            ASSERT_NEAR(sum, 1 - double(dead) / kPicks, 2e-3);
        }
    }
}

TEST(LightTree, HasNoDirectionalAndNoBlackLights) {
    EXPECT_FALSE(boundedLight(Light{.name = {}, .type = LightType::Directional}, 0));
    EXPECT_FALSE(boundedLight(Light{.name = {}, .intensity = glm::vec3(0)}, 0));
    EXPECT_TRUE(LightTree().empty());
}

}  // namespace
}  // namespace voxray
