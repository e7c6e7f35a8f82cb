// Where rays through voxels begin and end between surfaces: flat, convex and concave ones don't hide
// themselves, and what lies between is missed only near an end.
#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <random>

#include "tests/gpu/between_surfaces.h"
#include "tests/gpu/chain.h"

namespace voxray::test {
namespace {

class RandomNumbers {
 public:
    float uniform() { return uniform_(random_); }
    glm::vec3 direction() { return glm::normalize(glm::vec3(normal_(random_), normal_(random_), normal_(random_))); }

 private:
    std::mt19937 random_{7};
    std::uniform_real_distribution<float> uniform_{0, 1};
    std::normal_distribution<float> normal_;
};

struct SurfaceSample {
    glm::vec3 position, normal;
};

/// Points on a scene's surfaces, uniform over area, with the triangles' normals.
std::vector<SurfaceSample> surfaceSamples(const Geometry& g, size_t count, RandomNumbers& random) {
    std::vector<float> area;
    for (const glm::uvec3& t : g.triangles)
        area.push_back(
            glm::length(glm::cross(g.positions[t.y] - g.positions[t.x], g.positions[t.z] - g.positions[t.x])));
    std::discrete_distribution<size_t> pick(area.begin(), area.end());
    std::mt19937 picks(3);
    std::vector<SurfaceSample> samples(count);
    for (SurfaceSample& s : samples) {
        const glm::uvec3 t = g.triangles[pick(picks)];
        const glm::vec3 a = g.positions[t.x], ab = g.positions[t.y] - a, ac = g.positions[t.z] - a;
        float u = random.uniform(), v = random.uniform();
        if (u + v > 1) u = 1 - u, v = 1 - v;
        s = {a + u * ab + v * ac, glm::normalize(glm::cross(ab, ac))};
    }
    return samples;
}

/// Pairs of such points whose front sides face each other.
std::vector<SurfacePair> pairsOf(const Geometry& geometry, size_t count, RandomNumbers& random) {
    const std::vector<SurfaceSample> samples = surfaceSamples(geometry, 2 * count, random);
    std::vector<SurfacePair> pairs;
    for (size_t i = 0; i < count; ++i) {
        const SurfaceSample &a = samples[2 * i], &b = samples[2 * i + 1];
        const glm::vec3 way = b.position - a.position;
        if (glm::dot(a.normal, way) < 1e-3f || glm::dot(b.normal, way) > -1e-3f) continue;
        pairs.push_back({a.position, a.normal, b.position, b.normal});
    }
    return pairs;
}

const SurfaceVoxels& voxelsOf(const Chain& chain) {
    return chain.get<SurfaceVoxels>("voxels");
}

size_t sum(const std::vector<uint32_t>& hidden) {
    size_t count = 0;
    for (const uint32_t one : hidden) count += one;
    return count;
}

/// From points of surfaces into the open, on their outer side: rays from half a degree above the surface on.
std::vector<SurfacePair> raysIntoTheOpen(const std::vector<SurfaceSample>& samples, float length,
                                         RandomNumbers& random) {
    std::vector<SurfacePair> pairs;
    for (const SurfaceSample& s : samples) {
        glm::vec3 along = random.direction();
        along = glm::normalize(along - glm::dot(along, s.normal) * s.normal);
        const float angle = std::pow(random.uniform(), 3.0f) * 1.56f + 0.0087f;
        const glm::vec3 direction = std::cos(angle) * along + std::sin(angle) * s.normal;
        pairs.push_back({s.position, s.normal, s.position + length * direction, -direction});
    }
    return pairs;
}

TEST(VoxelEnds, FlatSurfacesDoNotHideThemselvesAtAnyTilt) {
    RandomNumbers random;
    for (int tilt = 0; tilt < 12; ++tilt) {
        auto state = builtin("plane");
        Geometry& g = state->geometry;
        const glm::quat rotation = glm::angleAxis(tilt == 0 ? 0 : 3 * random.uniform(), random.direction());
        g.boundsMin = glm::vec3(1e9f), g.boundsMax = glm::vec3(-1e9f);
        for (glm::vec3& p : g.positions) {
            p = rotation * p;
            g.boundsMin = glm::min(g.boundsMin, p), g.boundsMax = glm::max(g.boundsMax, p);
        }
        g.region = {g.boundsMin, g.boundsMax};
        Chain chain(state, graphYaml({"voxelize, resolution: 32"}), 8, 8);
        std::vector<SurfaceSample> samples = surfaceSamples(g, 20000, random);
        for (size_t i = 0; i < samples.size(); i += 2) samples[i].normal = -samples[i].normal;
        EXPECT_EQ(sum(hiddenByVoxels(voxelsOf(chain), raysIntoTheOpen(samples, 500, random))), 0u) << tilt;
    }
}

TEST(VoxelEnds, ConvexSurfacesDoNotHideThemselves) {
    // A ray that begins above a tangent plane's voxels and rises meets none that a body below the plane
    // touches
    RandomNumbers random;
    Chain chain("furnace", "{shape: sphere}", graphYaml({"voxelize, resolution: 32"}), 8, 8);
    std::vector<SurfaceSample> samples = surfaceSamples(chain.state().geometry, 50000, random);
    for (SurfaceSample& s : samples)
        if (glm::dot(s.normal, s.position) < 0) s.normal = -s.normal;
    EXPECT_EQ(sum(hiddenByVoxels(voxelsOf(chain), raysIntoTheOpen(samples, 500, random))), 0u);
}

TEST(VoxelEnds, ConcaveEdgesHideWithinTwoVoxels) {
    RandomNumbers random;
    Chain chain("furnace", "{shape: box}", graphYaml({"voxelize, resolution: 32"}), 8, 8);
    const std::vector<SurfacePair> pairs = pairsOf(chain.state().geometry, 50000, random);
    const std::vector<uint32_t> hidden = hiddenByVoxels(voxelsOf(chain), pairs);
    // The distance to the second nearest wall
    const auto fromEdge = [](glm::vec3 p) {
        glm::vec3 d = 1.0f - glm::abs(p);
        if (d.x > d.y) std::swap(d.x, d.y);
        if (d.y > d.z) std::swap(d.y, d.z);
        return std::max(d.x, d.y);
    };
    const float near = 2 * voxelsOf(chain).grid.voxelSize;
    for (size_t i = 0; i < pairs.size(); ++i) {
        if (std::min(fromEdge(pairs[i].a), fromEdge(pairs[i].b)) > near) {
            ASSERT_EQ(hidden[i], 0u) << i;
        }
    }
    const double part = double(sum(hidden)) / double(pairs.size());
    std::printf("a box of 32 voxels: %.4f of the pairs are hidden\n", part);
    EXPECT_GT(pairs.size(), 20000u);
    EXPECT_LT(part, 0.13);
}

TEST(VoxelEnds, ConcaveCurvesHideLittle) {
    RandomNumbers random;
    for (const int resolution : {32, 64, 128}) {
        Chain chain("furnace", "{shape: sphere}", graphYaml({fmt::format("voxelize, resolution: {}", resolution)}), 8,
                    8);
        const std::vector<SurfacePair> pairs = pairsOf(chain.state().geometry, 50000, random);
        const double part = double(sum(hiddenByVoxels(voxelsOf(chain), pairs))) / double(pairs.size());
        std::printf("a sphere of %d voxels: %.4f of the pairs are hidden\n", resolution, part);
        EXPECT_GT(pairs.size(), 20000u);
        EXPECT_LT(part, 0.001);
    }
}

TEST(VoxelEnds, WhatLiesBetweenIsMissedOnlyNearAnEnd) {
    // Of the way at most |n.x| + |n.y| + |n.z| voxels off the surface and a voxel's diagonal are passed over
    RandomNumbers random;
    Chain chain("thin_wall", "{thickness: 0.05}", graphYaml({"voxelize, resolution: 32"}), 8, 8);
    const std::vector<SurfacePair> pairs = pairsOf(chain.state().geometry, 50000, random);
    const std::vector<uint32_t> exact = hiddenByTriangles(chain.state(), pairs);
    const std::vector<uint32_t> hidden = hiddenByVoxels(voxelsOf(chain), pairs);
    const float passed = 2 * std::sqrt(3.0f) * voxelsOf(chain).grid.voxelSize;
    const EmbreeScene embree(chain.state());
    size_t missed = 0, across = 0;
    for (size_t i = 0; i < pairs.size(); ++i) {
        if (!exact[i]) continue;
        ++across;
        if (hidden[i]) continue;
        ++missed;
        // What is missed is near an end: the way between is open
        const SurfacePair& p = pairs[i];
        const glm::vec3 way = p.b - p.a;
        const float length = glm::length(way);
        if (length <= 2 * passed) continue;
        const glm::vec3 direction = way / length;
        EXPECT_FALSE(embree.occluded({p.a + passed * direction, 0, direction, length - 2 * passed})) << i;
    }
    std::printf("%zu of %zu pairs that a surface hides are missed\n", missed, across);
    EXPECT_GT(across, 1000u);
    EXPECT_LT(double(missed), 0.05 * double(across));
}

}  // namespace
}  // namespace voxray::test
