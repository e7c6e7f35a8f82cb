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

#include "tests/support/tree_lights.h"

namespace voxray {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

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
