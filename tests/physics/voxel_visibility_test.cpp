// Rays through voxels as passes use them: from both ends, steps by an epsilon, streams, shadows.
#include <gtest/gtest.h>

#include "tests/physics/walked_voxels.h"
#include "tests/support/errors.h"

namespace voxray::test {
namespace {

TEST(VoxelVisibility, SeesTheSameFromBothEnds) {
    WalkedVoxels voxels = sparseVoxels();
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<Ray> pairs(100000);
    const glm::vec3 extent = glm::vec3(voxels.grid.resolution) * voxels.grid.voxelSize;
    for (Ray& ray : pairs) {
        const auto point = [&] {
            return voxels.grid.origin + extent * glm::vec3(uniform(random), uniform(random), uniform(random));
        };
        ray.origin = point();
        ray.direction = 0.3f * (point() - ray.origin);
    }
    for (const VoxelTraversal walk : {VoxelTraversal::Bits, VoxelTraversal::Bricks, VoxelTraversal::Svo}) {
        size_t seen = 0;
        for (const WalkAnswer& answer : voxels.walk(walk, pairs, 0, true)) {
            ASSERT_TRUE(answer.hit == 0 || answer.hit == 3);
            seen += answer.hit == 0;
        }
        EXPECT_GT(seen, pairs.size() / 10);
        EXPECT_LT(seen, pairs.size() * 9 / 10);
    }
}

TEST(VoxelVisibility, StepsByAnEpsilonSkipSlivers) {
    // Sun and Agu 2015, figure 3, line 20: the larger the epsilon, the more corners of voxels are missed.
    WalkedVoxels voxels = sparseVoxels();
    const std::vector<Ray> rays = raysThroughGrid(voxels.grid, 200000, 6);
    const std::vector<WalkAnswer> exact = voxels.walk(VoxelTraversal::SvoRestart, rays);
    double before = 0;
    for (const float epsilon : {1e-4f, 1e-3f, 1e-2f, 1e-1f}) {
        const std::vector<WalkAnswer> steps = voxels.walk(VoxelTraversal::SvoRestart, rays, epsilon);
        size_t occlusion = 0, closest = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            occlusion += steps[i].hit != exact[i].hit;
            closest += steps[i].voxel != exact[i].voxel && steps[i].hit == exact[i].hit;
        }
        const double fraction = double(occlusion + closest) / double(rays.size());
        std::printf("epsilon %g voxels: occlusion differs for %.2g of the rays, the closest voxel alone for %.2g\n",
                    double(epsilon), double(occlusion) / double(rays.size()), double(closest) / double(rays.size()));
        EXPECT_GE(fraction, before);
        EXPECT_LT(fraction, 0.01 + 2 * epsilon);
        before = fraction;
    }
    EXPECT_GT(before, 1e-3);
}

TEST(VoxelVisibility, PassesAFullGridAndAnEmptyOne) {
    // A single voxel, all voxels and none but one in a far corner; rays without end from outside and within.
    for (const uint32_t resolution : {1u, 16u, 65u}) {
        for (const bool full : {true, false}) {
            WalkedVoxels voxels(glm::uvec3(resolution), 0.125f,
                                [&](glm::ivec3 v) { return full || v == glm::ivec3(int(resolution) - 1); });
            const std::vector<Ray> rays = raysThroughGrid(voxels.grid, 2000, 7);
            const std::vector<WalkAnswer> expected = voxels.walk(VoxelTraversal::Bits, rays);
            for (const WalkAnswer& a : expected) ASSERT_TRUE(!full || (a.hit != 0) == (a.start.x >= 0));
            for (const VoxelTraversal walk :
                 {VoxelTraversal::Bricks, VoxelTraversal::SvoRestart, VoxelTraversal::Svo}) {
                const std::vector<WalkAnswer> answers = voxels.walk(walk, rays);
                for (size_t i = 0; i < rays.size(); ++i) {
                    ASSERT_EQ(answers[i].hit, expected[i].hit) << i;
                    ASSERT_EQ(answers[i].voxel, expected[i].voxel) << i;
                }
            }
        }
    }
}

TEST(VoxelVisibility, StreamsHaveTheTracersInterface) {
    WalkedVoxels voxels = sphereVoxels();
    std::vector<Ray> rays = raysThroughGrid(voxels.grid, 20000, 8);
    const std::vector<WalkAnswer> expected = voxels.walk(VoxelTraversal::Bits, rays);
    rays.push_back({glm::vec3(0), 0, glm::vec3(1), -1});         // Inactive.
    rays.push_back({glm::vec3(kInfinity), 0, glm::vec3(1), 1});  // Not finite.
    rays.push_back({glm::vec3(0), 0, glm::vec3(0, std::nanf(""), 1), 1});
    std::mt19937 random(1);
    for (const auto& [walk, name] : EnumNames<VoxelTraversal>::names) {
        const std::vector<Hit> hits = voxels.closestHits(walk, rays);
        for (size_t i = 0; i < expected.size(); ++i) {
            ASSERT_EQ(hits[i].triangle != Hit::kMiss, expected[i].hit != 0) << name;
            ASSERT_EQ(hits[i].t, expected[i].hit ? expected[i].t : rays[i].tMax) << name;
        }
        for (size_t i = expected.size(); i < rays.size(); ++i) EXPECT_EQ(hits[i].triangle, Hit::kMiss) << name;
    }
}

TEST(VoxelVisibility, RefusesGridsThatItCantWalkThrough) {
    TestPrograms programs;
    VoxelMarch march(programs, VoxelTraversal::Bits);
    SurfaceVoxels window;
    window.grid = madeUpGrid(glm::uvec3(64), 1);
    window.grid.windowSize = 32;
    MemoryPlan plan;
    EXPECT_ERROR("64x64x64, of which 32 are held", march.plan(plan, window));
}

TEST(VoxelVisibility, ShadowsNarrowToThoseOfSurfaces) {
    // Direct light of a room with two blocks under a point light, by shadow rays through voxels and through
    // triangles: what differs are bands along shadows and edges, as wide as voxels. Pixels are smaller: else
    // a band shows or doesn't for a whole line of them.
    const auto chain = [](const std::string& visibility, int resolution) {
        return Chain("cornell", "{lights: point}",
                     fmt::format("[{{pass: gbuffer}}, {{pass: voxelize, resolution: {}}}, {{pass: "
                                 "direct_shadow_rays, visibility: {}}}]",
                                 resolution, visibility),
                     640, 640);
    };
    Chain exact = chain("exact", 16);
    const ImageF expected = exact.image("direct");
    EXPECT_EQ(exact.frameSamples.back().voxelSteps, 0u);
    double before = 0.1;
    for (const int resolution : {32, 64, 128, 256}) {
        Chain voxels = chain("voxels", resolution);
        const ImageF image = voxels.image("direct");
        const double difference = meanDifference(image, expected);
        std::printf("%d voxels: energy %.4f of the exact, mean difference %.4f\n", resolution,
                    mean(image) / mean(expected), difference);
        EXPECT_LT(difference, 0.6 * before);
        EXPECT_LT(mean(image), 1.01 * mean(expected)) << "voxels enclose the surfaces";
        before = difference;

        const PassSample& sample = voxels.frameSamples.back();
        EXPECT_EQ(sample.rays, exact.frameSamples.back().rays);
        EXPECT_GT(sample.voxelSteps, sample.rays);
        EXPECT_GT(reported(sample, "voxel visits"), double(sample.voxelSteps));
    }
    EXPECT_LT(before, 0.01);
}

}  // namespace
}  // namespace voxray::test
