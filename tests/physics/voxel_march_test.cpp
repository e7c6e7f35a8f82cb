// Walks of rays through voxels against a brute-force walk in doubles. Between two whole-numbered points that
// walk is exact: quotients of whole numbers below 2^25 differ by more than a double's rounding, or not at
// all.
#include <gtest/gtest.h>

#include <glm/gtx/component_wise.hpp>

#include "tests/physics/walked_voxels.h"

namespace voxray::test {
namespace {

constexpr int kUnits = 1 << 14;  // A voxel's, shaders/voxel_march/segment.glsl.
constexpr uint32_t kNoFace = 6;

struct Found {
    bool hit = false;
    glm::ivec3 voxel{-1};
    double part = 0;     ///< Of the segment, where the voxel begins.
    uint32_t steps = 0;  ///< WalkedVoxels before it.
};

/// The first occupied voxel between two points in units. Voxel by voxel: of the planes in front the one
/// reached first, upwards before downwards, several where they are reached at once.
Found bruteForce(const WalkedVoxels& voxels, glm::dvec3 start, glm::dvec3 end, double unit) {
    Found found;
    found.voxel = glm::ivec3(glm::floor(start / unit));
    const glm::dvec3 way = end - start;
    for (;; ++found.steps) {
        if (voxels.occupied(found.voxel)) {
            found.hit = true;
            return found;
        }
        std::pair<double, bool> first{2.0, false};
        std::array<std::pair<double, bool>, 3> reached;
        for (int axis = 0; axis < 3; ++axis) {
            const bool down = way[axis] < 0;
            const double plane = unit * (found.voxel[axis] + (down ? 0 : 1));
            const double part = std::abs(plane - start[axis]) / std::abs(way[axis]);
            const bool isWithin = way[axis] != 0 && (down ? part < 1 : part <= 1);
            reached[size_t(axis)] = {isWithin ? part : 3.0, down};
            first = std::min(first, reached[size_t(axis)]);
        }
        if (first.first > 1) return found;
        found.part = first.first;
        for (int axis = 0; axis < 3; ++axis)
            if (reached[size_t(axis)] == first) found.voxel[axis] += first.second ? -1 : 1;
    }
}

/// Rays along axes, faces and edges, through corners, of no length, from and to planes between voxels, from
/// within, out of the grid and past it.
std::vector<Ray> adversarialRays(const gpu::VoxelGrid& grid, size_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(0, 1);
    const auto any = [&](int smallest, int largest) {
        return std::uniform_int_distribution<int>(smallest, largest)(random);
    };
    std::vector<Ray> rays(count);
    for (size_t i = 0; i < count; ++i) {
        // In voxels: on corners, edges, faces or within, at times beyond the border or exactly on it.
        glm::vec3 from, way;
        for (int axis = 0; axis < 3; ++axis) {
            const int size = int(grid.resolution[axis]);
            from[axis] = float(any(-1, size + 1));
            if (any(0, 2) == 0) from[axis] += i % 5 == 0 ? 0.5f : uniform(random);
            if (any(0, 9) == 0) from[axis] = any(0, 1) ? 0.0f : float(size);
            way[axis] = float(any(-1, 1)) * (i % 4 == 0 ? float(any(1, 4)) : 1.0f);
            if (i % 7 == 0) way[axis] *= std::ldexp(1.0f, any(-30, 0));
        }
        if (any(0, 9) == 0) way = glm::vec3(0, -0.0f, 0);
        const float length = any(0, 3) == 0 ? kInfinity : float(any(0, int(grid.resolution.x)));
        rays[i] = {grid.origin + from * grid.voxelSize, 0, way * grid.voxelSize, length};
    }
    return rays;
}

/// Checks the walks' common answers against the brute-force walk along the segments that they walked.
void expectBruteForce(WalkedVoxels& voxels, const std::vector<Ray>& rays) {
    const std::vector<WalkAnswer> answers = voxels.walk(VoxelTraversal::Bits, rays);
    uint64_t steps = 0, hits = 0, inGrid = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const WalkAnswer& a = answers[i];
        if (a.start.x < 0) {
            ASSERT_EQ(a.hit, 0u) << i;
            continue;
        }
        ++inGrid;
        const Found found = bruteForce(voxels, glm::dvec3(a.start) + 0.5, glm::dvec3(a.end) + 0.5, kUnits);
        ASSERT_EQ(a.hit != 0, found.hit) << i;
        ASSERT_EQ(a.steps, found.steps) << i;
        steps += found.steps;
        if (!found.hit) continue;
        ++hits;
        ASSERT_EQ(a.voxel, found.voxel) << i;
        ASSERT_TRUE(std::isfinite(a.t)) << i;
        ASSERT_GE(a.t, rays[i].tMin) << i;
        ASSERT_LE(a.t, rays[i].tMax) << i;
        ASSERT_EQ(a.face == kNoFace, found.steps == 0) << i;
    }
    EXPECT_EQ(voxels.counts[0], steps) << "steps that were counted on the device";
    EXPECT_GT(hits, rays.size() / 100);
    EXPECT_GT(inGrid, hits);

    for (const VoxelTraversal walk :
         {VoxelTraversal::Bricks, VoxelTraversal::SvoRestart, VoxelTraversal::SvoVoxels, VoxelTraversal::Svo}) {
        const std::vector<WalkAnswer> others = voxels.walk(walk, rays);
        for (size_t i = 0; i < rays.size(); ++i) {
            WalkAnswer expected = answers[i];
            ASSERT_LE(others[i].steps, expected.steps) << i;
            expected.steps = others[i].steps;
            ASSERT_EQ(others[i], expected) << i << " by walk " << int(walk);
        }
        if (walk == VoxelTraversal::SvoVoxels)
            EXPECT_EQ(voxels.counts[0], steps);
        else
            EXPECT_LT(voxels.counts[0], steps);
    }
}

TEST(VoxelMarch, FindsWhatABruteForceWalkFinds) {
    WalkedVoxels sparse = sparseVoxels(), sphere = sphereVoxels(), empty = emptyVoxels(), far = longVoxels();
    expectBruteForce(sparse, raysThroughGrid(sparse.grid, 300000, 1));
    expectBruteForce(far, raysThroughGrid(far.grid, 100000, 9));
    expectBruteForce(sphere, raysThroughGrid(sphere.grid, 300000, 2));
    expectBruteForce(empty, raysThroughGrid(empty.grid, 300000, 3));
}

TEST(VoxelMarch, FindsItAlongAxesFacesAndEdges) {
    WalkedVoxels sparse = sparseVoxels(), sphere = sphereVoxels(), empty = emptyVoxels(), far = longVoxels();
    for (WalkedVoxels* voxels : {&sparse, &sphere, &empty, &far})
        expectBruteForce(*voxels, adversarialRays(voxels->grid, 25000));
}

TEST(VoxelMarch, WalksAlongTheRayThatItIsGiven) {
    // The segments' ends against the ray cut at the grid's faces in doubles, within rounding of what is
    // computed in floats; where both find a voxel it begins at the same place.
    WalkedVoxels voxels = sparseVoxels();
    const std::vector<Ray> rays = raysThroughGrid(voxels.grid, 200000, 4);
    const std::vector<WalkAnswer> answers = voxels.walk(VoxelTraversal::Svo, rays);
    const glm::dvec3 size(voxels.grid.resolution);
    size_t different = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 from =
            (glm::dvec3(rays[i].origin) - glm::dvec3(voxels.grid.origin)) / double(voxels.grid.voxelSize);
        const glm::dvec3 way = glm::dvec3(rays[i].direction) / double(voxels.grid.voxelSize);
        double begin = rays[i].tMin, end = rays[i].tMax;
        for (int axis = 0; axis < 3; ++axis) {
            const double low = -from[axis] / way[axis], high = (size[axis] - from[axis]) / way[axis];
            begin = std::max(begin, std::min(low, high));
            end = std::min(end, std::max(low, high));
        }
        if (answers[i].start.x < 0) {
            ASSERT_LT((end - begin) * glm::length(way), 1e-3) << i;
            continue;
        }
        const double tolerance = 1.5 / kUnits + 5e-6 * glm::compMax(size);
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_NEAR(answers[i].start[axis] / double(kUnits), from[axis] + begin * way[axis], tolerance) << i;
            ASSERT_NEAR(answers[i].end[axis] / double(kUnits), from[axis] + end * way[axis], tolerance) << i;
        }

        // Without rounding to units another voxel is met where the ray passes one's edge.
        const auto inside = [&](glm::dvec3 p) { return glm::clamp(p, glm::dvec3(0), size - 1e-9); };
        const Found found = bruteForce(voxels, inside(from + begin * way), inside(from + end * way), 1.0);
        if (found.hit != (answers[i].hit != 0) || (found.hit && found.voxel != answers[i].voxel)) {
            ++different;
            continue;
        }
        if (found.hit) {
            EXPECT_NEAR(answers[i].t, begin + found.part * (end - begin), 1e-4 * (1 + end)) << i;
        }
    }
    EXPECT_LT(double(different) / double(rays.size()), 2e-3);
    std::printf("units instead of doubles: %.2g of the answers differ\n", double(different) / double(rays.size()));
}

}  // namespace
}  // namespace voxray::test
